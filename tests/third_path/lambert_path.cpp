// A third path, added to the program by this folder alone.
#include <bit>

#include "job/paths.h"
#include "shading/shading.h"
#include "third_path_shaders/lambert.comp.h"

namespace parity::tests {

namespace {

struct LambertOptions {
  float albedoScale = 1;
};

std::array<glm::vec4, gpu::kPathNumbers> numbersOf(const paths::Light& light) {
  std::array<glm::vec4, gpu::kPathNumbers> numbers{};
  if (!light.environment) return numbers;
  shading::f32::IrradianceSh sh;
  for (std::size_t i = 0; i < 9; ++i) {
    const glm::vec3& c = light.environment->irradianceSh[i];
    sh.c[i] = {c.x, c.y, c.z};
  }
  const shading::f32::SkySh sky = shading::f32::packSkySh(sh, 4);
  for (int i = 0; i < 9; ++i) numbers[gpu::kPathSkySh + i] = glm::vec4(sky.c[i].x, sky.c[i].y, sky.c[i].z, 0);
  return numbers;
}

class LambertRenderer final : public paths::Renderer {
public:
  LambertRenderer(const paths::Inputs& inputs, const LambertOptions& options) {
    gpu::PathProgram program;
    program.name = "lambert";
    program.spirv = kLambertComp;
    for (const scenes::Light& light : inputs.light.lights)
      if (light.kind == scenes::LightKind::directional)
        program.lights.push_back(gpu::packLight(light));
      else
        m_hasLocal = true;
    program.directionalCount = static_cast<std::uint32_t>(program.lights.size());
    program.pathData = {0};
    program.numbers = numbersOf(inputs.light);
    program.constants = {std::bit_cast<std::uint32_t>(options.albedoScale)};
    program.terms = inputs.terms;
    program.expectedPixels = inputs.expectedPixels;
    program.compilation = inputs.compilation;
    m_pass = std::make_unique<gpu::ShadingPass>(inputs.device, inputs.buffers, inputs.binKinds, std::move(program));
  }
  gpu::ShadedSurface shade(const gpu::Surface& surface, const scenes::Camera& camera) const override {
    return m_pass->shade(surface, camera);
  }
  const gpu::ShadingPass& pass() const override { return *m_pass; }
  std::size_t countSamplers(const gpu::Permutation& permutation) const override {
    return gpu::countTextures(permutation.textures);
  }
  paths::RendererWork work() const override { return {}; }
  std::vector<std::string> notes() const override {
    return m_hasLocal ? std::vector<std::string>{"has no local lights"} : std::vector<std::string>{};
  }

private:
  bool m_hasLocal = false;
  std::unique_ptr<gpu::ShadingPass> m_pass;
};

class LambertPath final : public paths::Path {
public:
  const std::string& name() const override {
    static const std::string name = "lambert";
    return name;
  }
  const std::string& title() const override { return name(); }
  const base::KnobTable<paths::Options>& knobs() const override {
    static const base::KnobTable<paths::Options> table = [] {
      base::KnobTable<LambertOptions> rows;
      rows.section("Paths", {"lambert"});
      rows.number<&LambertOptions::albedoScale>("albedo-scale", 0, 2, "Lambert path: times the base colour");
      return paths::knobsOf(rows);
    }();
    return table;
  }
  paths::LightNeeds lightNeeds(const paths::Options&) const override {
    return {.prefilter = {.levels = lighting::PrefilterLevels::first}};
  }
  std::unique_ptr<paths::Renderer> makeRenderer(const paths::Inputs& inputs,
                                                const paths::Options& options) const override {
    return std::make_unique<LambertRenderer>(inputs, options.of<LambertOptions>());
  }
  const std::vector<paths::Intermediate>& intermediates() const override {
    static const std::vector<paths::Intermediate> lit = {{"Lit", "all of it"}};
    return lit;
  }
};

const LambertPath kLambert;
const bool kIsAdded = (job::addPath(kLambert), true); // before main, and so before the table of knobs is made

} // namespace

} // namespace parity::tests
