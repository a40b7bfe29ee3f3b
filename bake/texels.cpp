#include "bake/texels.h"
