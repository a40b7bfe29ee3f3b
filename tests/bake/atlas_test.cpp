#include "bake/atlas.h"

#include <gtest/gtest.h>
