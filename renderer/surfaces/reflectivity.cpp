#include "renderer/surfaces/reflectivity.h"

#include <mutex>
#include <utility>

#include "renderer/surfaces/bistatic_nrcs.h"
#include "renderer/surfaces/nrcs_table.h"

namespace fanbeam::renderer {

struct Reflectivity::Shared {
  std::vector<materials::NrcsCurve> curves;
  std::vector<NrcsTable> tables;
  std::once_flag asked;
  std::vector<BistaticNrcs> bistatic;  // from the first question on
};

Reflectivity::Reflectivity(std::vector<materials::NrcsCurve> curves, const std::vector<bool>& met)
    : shared_(std::make_shared<Shared>()) {
  for (std::size_t i = 0; i < curves.size(); ++i)
    shared_->tables.emplace_back(met.empty() || met[i] ? curves[i] : materials::NrcsCurve());
  shared_->curves = std::move(curves);
}

const std::vector<materials::NrcsCurve>& Reflectivity::curves() const { return shared_->curves; }

const std::vector<NrcsTable>& Reflectivity::tables() const { return shared_->tables; }

const std::vector<BistaticNrcs>& Reflectivity::bistatic() const {
  std::call_once(shared_->asked, [this] {
    for (const NrcsTable& table : shared_->tables) shared_->bistatic.emplace_back(table);
  });
  return shared_->bistatic;
}

}  // namespace fanbeam::renderer
