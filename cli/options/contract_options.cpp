// By CLI11, as command_line.cpp, which it serves.
#include "cli/options/contract_options.h"

#include "cli/options/option_parts.h"
#include "cli/options/plan_options.h"

namespace parity::cli {

void addContractOptions(CLI::App& app, ContractCommand& contract, RawOptions& raw) {
  addSceneList(app, contract.scenes, contract.suite, contract.common);
  app.add_option("-o,--output", contract.output, "Folder to write: contract.json and the files that it names")
      ->type_name(kFolder)
      ->group(kOutputGroup)
      ->required();
  addKnobs(app, contract.common, raw, {"Scene", "Picture"}, {"baked"});
  addViewKnobs(app, raw);
  addRunOptions(app, contract.common, raw);
}

void addCalibrateOptions(CLI::App& app, CalibrateCommand& calibrate) {
  app.add_option("picture", calibrate.picture,
                 "Picture of the contract's calibration.glb, or the folder that holds calibration.png")
      ->type_name(kFile)
      ->required();
}

} // namespace parity::cli
