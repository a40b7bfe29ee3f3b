// OpenEXR's core library, as its documentation has it written with: chunk by chunk.
#include "exr_writer.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "base/file.h"

namespace parity::base {

namespace {

void require(exr_result_t result) {
  if (result != EXR_ERR_SUCCESS) throw std::runtime_error(exr_get_error_code_as_string(result));
}

void writeHeader(exr_context_t file, const ExrKind& kind) {
  int part = 0;
  const bool isTiled = kind.tileWidth > 0;
  require(exr_add_part(file, "", isTiled ? EXR_STORAGE_TILED : EXR_STORAGE_SCANLINE, &part));
  const exr_attr_box2i_t data{{{kind.x, kind.y}}, {{kind.x + kind.width - 1, kind.y + kind.height - 1}}};
  const exr_attr_box2i_t display{{{kind.x - 3, kind.y - 3}}, {{kind.x + kind.width + 2, kind.y + kind.height + 2}}};
  const exr_attr_v2f_t center{{{0, 0}}};
  require(exr_initialize_required_attr(file, 0, &display, &data, 1, &center, 1, EXR_LINEORDER_INCREASING_Y,
                                       kind.compression));
  if (isTiled)
    require(exr_set_tile_descriptor(file, 0, static_cast<std::uint32_t>(kind.tileWidth),
                                    static_cast<std::uint32_t>(kind.tileHeight), EXR_TILE_ONE_LEVEL,
                                    EXR_TILE_ROUND_DOWN));
  for (std::size_t c = 0; c < kind.names.size(); ++c)
    require(exr_add_channel(file, 0, kind.names[c].c_str(),
                            kind.halves[c % kind.halves.size()] ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT,
                            EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1));
  if (kind.hasChromaticities) {
    const exr_attr_chromaticities_t values{.1f, .2f, .3f, .4f, .5f, .6f, .7f, .8f};
    require(exr_attr_set_chromaticities(file, 0, "chromaticities", &values));
  }
  if (kind.orientation) require(exr_attr_set_int(file, 0, "Orientation", kind.orientation));
  if (!kind.colorSpace.empty()) require(exr_attr_set_string(file, 0, "oiio:ColorSpace", kind.colorSpace.c_str()));
  require(exr_write_header(file));
}

// Every chunk has the samples from its own beginning on, so that no two are alike.
void writeChunk(exr_context_t file, const ExrKind& kind, const exr_chunk_info_t& chunk,
                const std::vector<std::uint32_t>& bits) {
  exr_encode_pipeline_t pipeline{};
  require(exr_encoding_initialize(file, 0, &chunk, &pipeline));
  const auto count = static_cast<std::size_t>(chunk.width) * static_cast<std::size_t>(chunk.height);
  std::vector<std::vector<std::byte>> planes;
  for (int c = 0; c < pipeline.channel_count; ++c) {
    exr_coding_channel_info_t& channel = pipeline.channels[c];
    const auto size = static_cast<std::size_t>(channel.bytes_per_element);
    std::vector<std::byte> plane(count * size);
    for (std::size_t i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(chunk.idx) * 977 + i * kind.names.size() + static_cast<std::size_t>(c);
      std::memcpy(plane.data() + i * size, &bits[at % bits.size()], size);
    }
    planes.push_back(std::move(plane));
    channel.encode_from_ptr = reinterpret_cast<const std::uint8_t*>(planes.back().data());
    channel.user_pixel_stride = static_cast<std::int32_t>(size);
    channel.user_line_stride = static_cast<std::int32_t>(size) * chunk.width;
    channel.user_bytes_per_element = static_cast<std::int16_t>(size);
    channel.user_data_type = channel.data_type;
  }
  require(exr_encoding_choose_default_routines(file, 0, &pipeline));
  require(exr_encoding_run(file, 0, &pipeline));
  require(exr_encoding_destroy(file, &pipeline));
}

} // namespace

std::vector<std::byte> makeExr(const std::filesystem::path& path, const ExrKind& kind,
                               const std::vector<std::uint32_t>& bits) {
  exr_context_t file = nullptr;
  const exr_context_initializer_t start = EXR_DEFAULT_CONTEXT_INITIALIZER;
  require(exr_start_write(&file, path.c_str(), EXR_WRITE_FILE_DIRECTLY, &start));
  writeHeader(file, kind);
  exr_chunk_info_t chunk{};
  if (kind.tileWidth > 0) {
    for (int y = 0; y * kind.tileHeight < kind.height; ++y)
      for (int x = 0; x * kind.tileWidth < kind.width; ++x) {
        require(exr_write_tile_chunk_info(file, 0, x, y, 0, 0, &chunk));
        writeChunk(file, kind, chunk, bits);
      }
  } else {
    std::int32_t lines = 0;
    require(exr_get_scanlines_per_chunk(file, 0, &lines));
    for (int y = 0; y < kind.height; y += lines) {
      require(exr_write_scanline_chunk_info(file, 0, kind.y + y, &chunk));
      writeChunk(file, kind, chunk, bits);
    }
  }
  require(exr_finish(&file));
  return readFile(path);
}

} // namespace parity::base
