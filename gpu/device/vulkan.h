// Vulkan-Hpp's RAII layer, included in one way everywhere (and precompiled: it is 1 MB of header).
#pragma once

#define VULKAN_HPP_NO_SPACESHIP_OPERATOR
#include <vulkan/vulkan_raii.hpp>
