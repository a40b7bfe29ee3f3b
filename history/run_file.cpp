// JSON by the rows of run_records.h, gzip by libdeflate.
#include "history/run_file.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <memory>

#include <fmt/format.h>
#include <libdeflate.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "history/run_records.h"
#include "report/record/record_reader.h"
#include "report/record/record_writer.h"

namespace parity::history {

namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 30; // of its JSON
constexpr std::size_t kShownDigits = 12;                 // of the digest
constexpr const char* kDamaged = "is damaged; remove it, and add its report again if that is still there";

std::vector<std::byte> compress(const std::string& text) {
  constexpr int kLevel = 6;
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(kLevel), &libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  std::vector<std::byte> bytes(libdeflate_gzip_compress_bound(compressor.get(), text.size()));
  bytes.resize(libdeflate_gzip_compress(compressor.get(), text.data(), text.size(), bytes.data(), bytes.size()));
  return bytes;
}

// The last four bytes of a gzip file say how long its content is: of a file of unknown origin that is a claim.
std::string decompress(const std::vector<std::byte>& bytes, const std::string& file) {
  constexpr std::size_t kLeast = 18, kMostRatio = 1032; // of DEFLATE
  std::uint32_t size = 0;
  if (bytes.size() < kLeast) throw base::fileError(file, "", kDamaged);
  std::memcpy(&size, bytes.data() + bytes.size() - sizeof size, sizeof size);
  if (size > kMostBytes || size > bytes.size() * kMostRatio) throw base::fileError(file, "", kDamaged);
  std::string text(size, '\0');
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> decompressor(
      libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  if (!decompressor) throw std::bad_alloc();
  std::size_t written = 0;
  if (libdeflate_gzip_decompress(decompressor.get(), bytes.data(), bytes.size(), text.data(), text.size(), &written) !=
          LIBDEFLATE_SUCCESS ||
      written != size)
    throw base::fileError(file, "", kDamaged);
  return text;
}

std::string idOf(const RunRecord& record, const std::string& text) {
  std::string time;
  for (const char c : record.started)
    if (std::isalnum(static_cast<unsigned char>(c))) time += c; // 2026-11-25T03:00:12Z
  return time + "-" + base::Hasher().add(text).hex().substr(0, kShownDigits);
}

bool isRunId(const std::string& id) {
  constexpr std::size_t kTimeDigits = 16;
  return id.size() == kTimeDigits + 1 + kShownDigits && id[kTimeDigits] == '-' && id[8] == 'T' &&
         std::ranges::all_of(id, [](unsigned char c) { return std::isalnum(c) || c == '-'; });
}

} // namespace

EncodedRun encodeRun(const RunRecord& record) {
  report::RecordWriter writer(base::JsonLayout::compact);
  writer.write(record);
  const std::string text = writer.finish();
  EncodedRun run{idOf(record, text), compress(text)};
  if (!isRunId(run.id))
    throw base::fileError("run.json", "/startedAt",
                          fmt::format("'{}' is no time such as 2026-11-25T03:00:12Z", record.started));
  return run;
}

RunRecord readRunFile(const std::filesystem::path& file) {
  const std::string name = file.string();
  const std::string text = decompress(base::readFile(file), name);
  RunRecord record;
  try {
    const nlohmann::json json = nlohmann::json::parse(text);
    const report::Node root(json, name, "");
    if (const std::uint64_t format = root.at("history").count(); format != kRunFormat)
      root.at("history").refuse(
          fmt::format("is {}, from a newer version of parity; this one reads {}", format, kRunFormat));
    report::readRecord(root, record);
  } catch (const nlohmann::json::exception&) {
    throw base::fileError(name, "", kDamaged);
  }
  if (file.filename() != idOf(record, text) + kRunEnd) throw base::fileError(name, "", kDamaged);
  return record;
}

std::vector<std::string> listRuns(const std::filesystem::path& history) {
  std::vector<std::string> ids;
  std::error_code error;
  const std::filesystem::path folder = history / kRunFolder;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (!name.ends_with(kRunEnd)) continue;
    if (std::string id = name.substr(0, name.size() - std::strlen(kRunEnd)); isRunId(id)) ids.push_back(std::move(id));
  }
  if (error) throw base::fileError(folder.string(), "cannot be listed", error.message());
  std::ranges::sort(ids);
  return ids;
}

std::filesystem::path runFile(const std::filesystem::path& history, const std::string& id) {
  return history / kRunFolder / (id + kRunEnd);
}

} // namespace parity::history
