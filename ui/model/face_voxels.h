// The samples that faults cut, for faces that show them: read on a thread of their own, kept in step with the
// surfaces.
#pragma once
#include <QObject>
#include <QString>
#include <memory>
#include <set>

#include "ui/model/section_reader.h"
#include "ui/model/voxel_bricks.h"

namespace footwall::ui {

class FaceVoxels final : public QObject {
  Q_OBJECT

 public:
  // Bricks of all faults together hold at most so much; a fault whose share is too small for all its samples
  // has every second one, fourth one and so on.
  static constexpr std::size_t kMostBytes = std::size_t{128} << 20;
  static constexpr std::size_t kMostBytesOfOne = std::size_t{48} << 20;

  explicit FaceVoxels(Document& document, QObject* parent = nullptr);
  // Waits for the chunk that is being read.
  ~FaceVoxels() override;

  // What is to be there from now on: bricks of this volume around these surfaces, and nothing else. Those
  // that differ from what was asked for last are read; the newest surface of a fault wins.
  void want(Id volume, const std::vector<std::shared_ptr<const FaultSurface>>& surfaces);
  // The newest that were read, perhaps of a former surface of the fault; null before the first.
  std::shared_ptr<const VoxelBricks> bricks(Id fault) const;
  // Of the volume wanted, once it has been opened; else null.
  const SectionReader::VolumeFacts* facts() const;
  // All that is wanted is there, or could not be read.
  bool is_settled() const;

 Q_SIGNALS:
  void changed(const std::set<footwall::ui::Id>& faults);
  // One line of what happened, one of how to mend it.
  void failed(const QString& message, const QString& hint);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace footwall::ui
