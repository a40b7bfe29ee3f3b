// The material textures of the mobile path as a phone stores them, kept in the cache: a large one takes seconds.
#pragma once

#include "base/image/texture_block.h"
#include "gpu/surface/textures.h"
#include "job/context.h"

namespace parity::job {

// Compresses and decodes mips; in the cache they lie compressed. None for TextureBlock::none. context: must outlive it.
gpu::TextureCodec makeTextureCodec(const Context& context, base::TextureBlock block);

} // namespace parity::job
