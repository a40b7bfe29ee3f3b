// The module that holds the transcoder of Basis Universal: three.js ships it as WebAssembly made by Emscripten, wasm2c
// turns it into C, which can reach nothing but a memory of its own. Here stands what Emscripten's JavaScript does
// around it (basis_transcoder.js of the same package): embind tells its functions by name, and emval hands arrays over.
#include "base/image/basis/basis_module.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <mutex>
#include <vector>

#include "base/image/basis/wasm_runtime.h"
#include "basis_transcoder.h" // by wasm2c

namespace parity::base {

namespace {

// A JavaScript value, as far as the transcoder asks for any.
struct Value {
  enum class Kind { nothing, text, number, input, output, type, module, buffer, view } kind = Kind::nothing;
  std::string text{};
  double number = 0;
  std::uint32_t place = 0, size = 0; // of a view into the transcoder's memory
};

// A function that embind has named: called as invoker(context, arguments...).
struct Function {
  std::uint32_t invoker = 0, context = 0;
};

constexpr std::uint32_t kArgumentBytes = 8; // GenericWireTypeSize of embind

} // namespace

} // namespace parity::base

// The host of the module's imports; wasm2c names the type.
struct Z_a_instance_t {
  Z_basis_transcoder_instance_t wasm{};
  std::span<const std::byte> input;
  std::span<std::uint8_t> output;
  std::map<std::string, parity::base::Function>
      functions;                                // "KTX2File.getWidth", "KTX2File" (its constructor), "initializeBasis"
  std::map<std::uint32_t, std::string> classes; // names by their types
  std::vector<parity::base::Value> values{1};   // emval handles; 0 is none

  using Value = parity::base::Value;
  using Kind = Value::Kind;

  Z_a_instance_t() = default;
  ~Z_a_instance_t() { Z_basis_transcoder_free(&wasm); }
  Z_a_instance_t(const Z_a_instance_t&) = delete;
  Z_a_instance_t& operator=(const Z_a_instance_t&) = delete;

  std::uint8_t* memory(std::uint32_t place, std::uint32_t size) {
    if (size > wasm.w2c_L.size || place > wasm.w2c_L.size - size)
      throw parity::base::WasmTrap("an access out of bounds");
    return wasm.w2c_L.data + place;
  }
  std::uint32_t word(std::uint32_t place) {
    std::uint32_t value;
    std::memcpy(&value, memory(place, 4), 4);
    return value;
  }
  std::string text(std::uint32_t place) {
    constexpr std::size_t kLongest = 256;
    std::string result;
    for (; *memory(place, 1) != 0 && result.size() < kLongest; ++place)
      result.push_back(static_cast<char>(*memory(place, 1)));
    return result;
  }
  std::uint32_t add(Value value) {
    constexpr std::size_t kMostValues = 10000; // some 20 are made for a file
    if (values.size() > kMostValues) throw parity::base::WasmTrap("out of memory");
    values.push_back(std::move(value));
    return static_cast<std::uint32_t>(values.size() - 1);
  }
  const Value& valueOf(std::uint32_t handle) const {
    if (handle >= values.size()) throw parity::base::WasmTrap("a value that is not there");
    return values[handle];
  }

  template <typename... Arguments> std::uint32_t call(const std::string& name, Arguments... arguments) {
    const auto found = functions.find(name);
    if (found == functions.end()) throw parity::base::WasmTrap("a function that is not there");
    const wasm_rt_funcref_table_t& table = wasm.w2c_P;
    const std::uint32_t index = found->second.invoker;
    if (index >= table.size || !table.data[index].func) throw parity::base::WasmTrap("a function that is not there");
    using Pointer = std::uint32_t (*)(void*, std::uint32_t, Arguments...);
    return reinterpret_cast<Pointer>(table.data[index].func)(table.data[index].module_instance, found->second.context,
                                                             arguments...);
  }
};

namespace {

using Host = Z_a_instance_t;
using Kind = Host::Kind;
using parity::base::kArgumentBytes;

[[noreturn]] void refuse(const char* reason) { throw parity::base::WasmTrap(reason); }

} // namespace

// Imports in the order of their letters; what each is stands in `wasmImports` of basis_transcoder.js.
// NOLINTBEGIN(readability-function-size): their parameters are embind's.
extern "C" {

void Z_aZ_a(Host*, u32, u32, u32) {}                                    // _embind_register_enum_value
void Z_aZ_b(Host*, u32) {}                                              // _emval_decref: the values end with the file
void Z_aZ_c(Host*, u32, u32, u32, u32, u32, u32, u32, u32, u32, u32) {} // _embind_register_value_object_field

void Z_aZ_d(Host* host, u32 type, u32 name, u32, u32, u32, u32 invoker, u32 context, u32,
            u32) { // _embind_register_class_function
  host->functions[host->classes[type] + "." + host->text(name)] = {invoker, context};
}

void Z_aZ_e(Host*, u32) {}           // _emval_run_destructors
void Z_aZ_f(Host*, u32, u32, u32) {} // _embind_register_memory_view

u32 Z_aZ_g(Host* host, u32 object, u32 key) { // _emval_get_property
  const std::string& name = host->valueOf(key).text;
  if (name == "length" || name == "byteLength") {
    const bool isInput = host->valueOf(object).kind == Kind::input;
    return host->add(
        {.kind = Kind::number, .number = static_cast<double>(isInput ? host->input.size() : host->output.size())});
  }
  if (name == "buffer") return host->add({.kind = Kind::buffer});
  return host->add({.kind = Kind::type}); // "constructor"
}

u32 Z_aZ_h(Host* host, u32 text) {
  return host->add({.kind = Kind::text, .text = host->text(text)});
} // _emval_new_cstring

void Z_aZ_i(Host* host, u32 name, u32, u32, u32, u32 invoker, u32 function, u32) { // _embind_register_function
  host->functions[host->text(name)] = {invoker, function};
}

u32 Z_aZ_j(Host*, u32, u32, u32) { return 0; } // _emval_get_method_caller: we know what is called
void Z_aZ_k(Host*, u32) {}                     // _emval_incref
void Z_aZ_l(Host*, u32, u32, u32, u32, u32) {} // _embind_register_integer
void Z_aZ_m(Host*, u32, u32, f64) {}           // _embind_register_constant
f64 Z_aZ_n(Host* host, u32 value, u32, u32) { return host->valueOf(value).number; } // _emval_as
void Z_aZ_o(Host*, u32, u32, u32, u32) {}                                           // _embind_register_enum

f64 Z_aZ_p(Host* host, u32, u32 object, u32 method, u32, u32 arguments) { // _emval_call_method: to.set(from)
  if (host->text(method) != "set") refuse("a method that is not known");
  const Host::Value to = host->valueOf(object), from = host->valueOf(host->word(arguments));
  if (to.kind == Kind::view && from.kind == Kind::input && to.size >= host->input.size())
    std::memcpy(host->memory(to.place, to.size), host->input.data(), host->input.size());
  else if (to.kind == Kind::output && from.kind == Kind::view && from.size <= host->output.size())
    std::memcpy(host->output.data(), host->memory(from.place, from.size), from.size);
  else
    refuse("a copy of another size");
  return 0;
}

f64 Z_aZ_q(Host* host, u32, u32, u32, u32 arguments) { // _emval_call: new Uint8Array(buffer, place, size)
  return host->add({.kind = Kind::view,
                    .place = host->word(arguments + kArgumentBytes),
                    .size = host->word(arguments + 2 * kArgumentBytes)});
}

u32 Z_aZ_r(Host* host, u32) { return host->add({.kind = Kind::module}); } // _emval_get_module_property: HEAP8
void Z_aZ_s(Host*, u32) {}                                                // _embind_finalize_value_object
void Z_aZ_t(Host*, u32, u32, u32, u32, u32, u32) {}                       // _embind_register_value_object
void Z_aZ_u(Host*, u32, u32, u32) {}                                      // _embind_register_std_wstring

void Z_aZ_v(Host* host, u32 type, u32, u32, u32, u32 invoker, u32 constructor) { // _embind_register_class_constructor
  host->functions[host->classes[type]] = {invoker, constructor};
}

void Z_aZ_w(Host* host, u32 type, u32, u32, u32, u32, u32, u32, u32, u32, u32, u32 name, u32,
            u32) { // _embind_register_class
  host->classes[type] = host->text(name);
}

u32 Z_aZ_x(Host* host, u32) { return host->add({.kind = Kind::type}); } // _emval_get_global
u32 Z_aZ_y(Host*, u32, u32, u32, u32) { return 0; }                     // fd_write: it says nothing
void Z_aZ_z(Host*, u32, u32) {}                                         // _embind_register_std_string
void Z_aZ_A(Host*, u32, u32, u32) {}                                    // _embind_register_float
u32 Z_aZ_B(Host*, u32, u32, u32, u32, u32) { return 0; }                // fd_seek
void Z_aZ_C(Host*, u32, u32, u32, u32, u32, u32, u32) {}                // _embind_register_bigint

u32 Z_aZ_D(Host* host, u32 bytes) { // emscripten_resize_heap
  constexpr u32 kPageBytes = 65536;
  const u32 size = host->wasm.w2c_L.size;
  if (bytes <= size) return 1;
  return wasm_rt_grow_memory(&host->wasm.w2c_L, (bytes - size + kPageBytes - 1) / kPageBytes) != 0xffffffffu ? 1 : 0;
}

u32 Z_aZ_E(Host*, u32) { return 0; } // fd_close

void Z_aZ_F(Host* host, u32 to, u32 from, u32 size) { // _emscripten_memcpy_js
  std::memmove(host->memory(to, size), host->memory(from, size), size);
}

void Z_aZ_G(Host*) { refuse("it gave up"); }                // _abort_js
void Z_aZ_H(Host*, u32) {}                                  // _embind_register_emval
void Z_aZ_I(Host*, u32, u32, u32, u32) {}                   // _embind_register_bool
void Z_aZ_J(Host*, u32, u32) {}                             // _embind_register_void
void Z_aZ_K(Host*, u32, u32, u32) { refuse("it gave up"); } // __cxa_throw

} // extern "C"
// NOLINTEND(readability-function-size)

namespace parity::base {

namespace {

// An instance of the module for one file, with its memory.
class Transcoder {
public:
  Transcoder(std::span<const std::byte> file, std::span<std::uint8_t> texels) {
    static std::once_flag once;
    std::call_once(once, Z_basis_transcoder_init_module);
    m_host.input = file;
    m_host.output = texels;
    Z_basis_transcoder_instantiate(&m_host.wasm, &m_host);
    Z_basis_transcoderZ_M(&m_host.wasm); // static constructors, which name the functions
    m_host.call("initializeBasis");
  }

  std::string run() {
    constexpr std::uint32_t kRgba32 = 13; // transcoder_texture_format::cTFRGBA32
    const std::uint32_t none = 0, anyChannel = 0xffffffffu;
    const std::uint32_t file = m_host.call("KTX2File", m_host.add({.kind = Value::Kind::input}));
    const auto ask = [&](const char* name) { return m_host.call(std::string("KTX2File.") + name, file); };
    if (ask("isValid") == 0) return "is no KTX 2 file that the transcoder of Basis Universal reads";
    if (ask("startTranscoding") == 0) return "its tables are damaged";
    const std::uint32_t bytes = m_host.call("KTX2File.getImageTranscodedSizeInBytes", file, none, none, none, kRgba32);
    if (bytes != m_host.output.size()) return "its size is not that of its header";
    const std::uint32_t out = m_host.add({.kind = Value::Kind::output});
    return m_host.call("KTX2File.transcodeImage", file, out, none, none, none, kRgba32, none, anyChannel, anyChannel) !=
                   0
               ? ""
               : "its blocks are damaged";
  }

private:
  Z_a_instance_t m_host;
};

} // namespace

} // namespace parity::base

extern "C" __attribute__((visibility("default"))) void parityDecodeBasis(std::span<const std::byte> file,
                                                                         std::size_t memory,
                                                                         std::span<std::uint8_t> texels,
                                                                         std::string& damage) {
  constexpr std::size_t kPageBytes = 65536, kMostPages = 65535;
  parity::base::setWasmPages(static_cast<std::uint32_t>(std::min(memory / kPageBytes, kMostPages)));
  try {
    damage = parity::base::Transcoder(file, texels).run();
  } catch (const parity::base::WasmTrap& trap) {
    damage = std::string("cannot be transcoded: ") + trap.what();
  }
}
