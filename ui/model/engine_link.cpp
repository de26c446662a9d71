#include "ui/model/engine_link.h"

namespace footwall::ui {
struct EngineLink::Private {};
EngineLink::EngineLink(Document&, const Options&, QObject* parent) : QObject(parent), private_(std::make_unique<Private>()) {}
EngineLink::~EngineLink() = default;
EngineLink::State EngineLink::state() const { return State::kOff; }
QString EngineLink::state_text() const { return {}; }
int EngineLink::ranks() const { return 0; }
void EngineLink::start() {}
void EngineLink::stop() {}
void EngineLink::set_volume(Id) {}
std::uint64_t EngineLink::put_fault(const std::shared_ptr<const FaultSurface>&) { return 0; }
std::uint64_t EngineLink::remove_fault(Id) { return 0; }
std::uint64_t EngineLink::draw(const PictureRequest&) { return 0; }
}  // namespace footwall::ui
