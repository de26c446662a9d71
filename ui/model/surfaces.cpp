#include "ui/model/surfaces.h"

namespace footwall::ui {
struct Surfaces::State { std::vector<project::StatisticRecord> statistics; };
Surfaces::Surfaces(Document&, EngineLink*, QObject* parent) : QObject(parent), state_(std::make_unique<State>()) {}
Surfaces::~Surfaces() = default;
std::shared_ptr<const FaultSurface> Surfaces::surface(Id) const { return {}; }
QString Surfaces::problem(Id) const { return {}; }
std::shared_ptr<const FaceNumbers> Surfaces::numbers(Id, const QString&) const { return {}; }
Freshness Surfaces::freshness(Id, const QString&) const { return Freshness::kPlain; }
const std::vector<project::StatisticRecord>& Surfaces::statistics() const { return state_->statistics; }
std::optional<std::pair<double, double>> Surfaces::range(const std::set<Id>&, const QString&) const { return {}; }
pillars::Options Surfaces::options(Id) const { return {}; }
void Surfaces::set_options(Id, const pillars::Options&) {}
}  // namespace footwall::ui
