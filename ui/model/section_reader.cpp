#include "ui/model/section_reader.h"

namespace footwall::ui {
struct SectionReader::State {};
SectionReader::SectionReader(Document&, QObject* parent) : QObject(parent), state_(std::make_unique<State>()) {}
SectionReader::~SectionReader() = default;
void SectionReader::ask(QObject*, Id, const Section&) {}
std::shared_ptr<const SectionSamples> SectionReader::kept(Id, const Section&) const { return {}; }
const SectionReader::VolumeFacts* SectionReader::facts(Id) const { return nullptr; }
}  // namespace footwall::ui
