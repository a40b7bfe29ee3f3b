#include "bake/atlas.h"
