// The error type: one line, whatever the parts hold.
#include "base/error.h"

#include <gtest/gtest.h>

namespace parity::base {
namespace {

TEST(Error, SaysSubjectPlaceAndReasonInOneLine) {
  const Error error(ExitCode::usage, "a.gltf", "meshes[3]", "has no positions");
  EXPECT_STREQ(error.what(), "a.gltf: meshes[3]: has no positions");
  EXPECT_EQ(error.code(), ExitCode::usage);
  EXPECT_EQ(error.subject(), "a.gltf");
  EXPECT_EQ(error.place(), "meshes[3]");
  EXPECT_EQ(error.reason(), "has no positions");
}

TEST(Error, LeavesEmptyPartsOut) {
  EXPECT_STREQ(fileError("a.gltf", "", "is empty").what(), "a.gltf: is empty");
  EXPECT_STREQ(fileError("", "", "is empty").what(), "is empty");
  EXPECT_EQ(fileError("a", "b", "c").code(), ExitCode::failed);
}

TEST(Error, KeepsToOneLineWithNamesThatHoldControlCharacters) {
  EXPECT_STREQ(fileError("a\nb\x1b[31m", "c\td", "e\r\n").what(), "a b [31m: c d: e  ");
}

} // namespace
} // namespace parity::base
