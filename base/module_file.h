// The files of the program's modules: shared objects that are opened on first use, since their libraries take long to
// load.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace parity::base {

// Where a module of this name may lie, the likeliest first: beside the running program, beside the object that holds
// this code, or where an installation has it.
std::vector<std::filesystem::path> moduleCandidates(const std::string& file);

// The function of that name in the module, which stays loaded for good: what it throws may outlive any scope. Throws
// Error (failed): not found, not loadable (`needs`: "OpenImageIO 2.4 is needed: install ..."), without the function.
// use: what cannot be done without it.
void* moduleFunction(const std::string& file, const char* function, const std::string& needs, const std::string& use);

} // namespace parity::base
