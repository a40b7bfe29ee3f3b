#include "mobile/formulas.h"
#include "own_preset_shaders/linear_fp16.comp.h"
#include "own_preset_shaders/linear_fp32.comp.h"
#include "own_preset_shaders/linear_lobes_fp16.comp.h"
#include "own_preset_shaders/linear_lobes_fp32.comp.h"

static const bool kIsAdded = parity::mobile::addPreset(
    {.preset = "linear"}, {kLinearFp16Comp, kLinearFp32Comp, kLinearLobesFp16Comp, kLinearLobesFp32Comp});
