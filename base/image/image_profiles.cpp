// No ICC profile of a file is ever decoded: nothing here uses one, and the image library's decoder (OpenImageIO 2.4)
// adds a tag's offset and size in 32 bits, so that a profile of a few bytes makes it read far outside of it.
//
// The readers (JPEG, PNG, TIFF and what holds them) call the decoder through the dynamic linker, which looks for it in
// the module before it looks in the library. tests/base/image_profile_test.cpp fails where it does not.
#include <cstdint>
#include <string>

#include <OpenImageIO/imageio.h>

OIIO_NAMESPACE_BEGIN

// As OpenImageIO/tiffutils.h declares it, which needs the headers of libtiff.
OIIO_API bool decode_icc_profile(cspan<uint8_t> profile, ImageSpec& spec, std::string& error);

bool decode_icc_profile(cspan<uint8_t> /*profile*/, ImageSpec& /*spec*/, std::string& /*error*/) { return true; }

OIIO_NAMESPACE_END
