// What a stress run has to say: what it found, what the sources' own formulas are known for, what has vanished.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace parity::stress {

struct Finding {
  std::string subject;   // a function of the table, or a scene
  std::string place;     // "cpu fp16", "device fp32"; of a scene the path: "mobile karis2014 fp16"
  std::string fault;     // in words: "not finite", "vanished"...
  bool expected = false; // known, with its region and reason; the run is not failed by it
  std::uint64_t count = 0;
  double magnitude = 0;       // of the worst: by what findings of one kind are sorted
  std::string example;        // the worst one in words
  std::string reproduce;      // arguments of parity stress
  std::string region, reason; // of an expected finding, or of one that vanished
};

// Unexpected first, then by subject and place.
void sortFindings(std::vector<Finding>& findings);

} // namespace parity::stress
