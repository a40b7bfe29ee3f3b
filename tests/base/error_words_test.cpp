// Libraries' own texts do not reach who reads a message.
#include "base/text/error_words.h"

#include <filesystem>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "base/error.h"

namespace parity::base {
namespace {

std::string wordsOfThrown(void (*body)()) {
  try {
    body();
  } catch (const std::exception& error) {
    return wordsOf(error);
  }
  return "nothing was thrown";
}

TEST(ErrorWords, AreOursWhateverWasThrown) {
  EXPECT_EQ(wordsOfThrown([] { throw fileError("a.glb", "byte 3", "is cut"); }), "a.glb: byte 3: is cut");
  EXPECT_EQ(wordsOfThrown([] { std::vector<int>().resize(std::size_t(-1)); }), "out of memory");
  EXPECT_EQ(wordsOfThrown([] { throw std::bad_alloc(); }), "out of memory");
  EXPECT_EQ(wordsOfThrown([] { std::vector<int>().at(3); }), "internal error, please report it");
  EXPECT_EQ(wordsOfThrown([] { (void)std::filesystem::file_size("/no/such file"); }),
            "/no/such file: No such file or directory");
  EXPECT_EQ(wordsOfThrown(
                [] { throw std::runtime_error("[json.exception.type_error.302] type must be string, but is number"); }),
            "type must be string, but is number");
  EXPECT_EQ(wordsOfThrown([] { throw std::runtime_error("[x"); }), "[x");
}

} // namespace
} // namespace parity::base
