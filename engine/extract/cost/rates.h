// What a machine takes for the steps of EXTRACT-ALL, as plain values that every rank knows alike.
#pragma once
#include <string>
#include <vector>

namespace footwall::extract {

// Seconds, of one core where nothing else is said.
struct MachineRates {
  // Of messages, see comm::LinkRates.
  double alpha = 0;     // latency
  double overhead = 0;  // of each further message
  double byte = 0;      // of each byte
  // Of voxels.
  double voxelize = 0;            // which voxels a face cuts, as spans
  double gather = 0;              // looks up a listed voxel's value and folds it
  double fold = 0;                // voxelizes, looks up and folds in one pass (`reduce`)
  double fold_discontinuity = 0;  // the same with the discontinuity
  double pack = 0;                // lists a voxel, and writes or reads its value in a message
  // Of faces.
  double face = 0;     // that a rank has at least one voxel of
  double finish = 0;   // writes, reads, merges and ends one partial sum
  double balance = 0;  // is dealt out by a balancer
  // Of computations that need a face's voxels, of each voxel. One that is not here was not measured.
  struct WholeFace {
    std::string name;
    double voxel = 0;
    friend bool operator==(const WholeFace&, const WholeFace&) = default;
  };
  std::vector<WholeFace> whole_face;
  int ranks = 1;  // among which they were measured
  int cores = 1;  // that these ranks may use, over all hosts

  // Of one computation; that of gathering where it was not measured.
  double whole_face_voxel(const std::string& name) const;
  friend bool operator==(const MachineRates&, const MachineRates&) = default;
};

// JSON, and back with every bit. Throws kFormat for what is not complete, positive and finite.
std::string to_text(const MachineRates& rates);
MachineRates rates_from(const std::string& text);

}  // namespace footwall::extract
