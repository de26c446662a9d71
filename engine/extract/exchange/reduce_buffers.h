// What `reduce` works in: made once for a survey, used for every extraction.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "engine/comm/communicator.h"
#include "engine/extract/exchange/exchange.h"
#include "engine/extract/face_order.h"
#include "engine/extract/fold_rows.h"
#include "engine/voxelize/rows.h"

namespace footwall::extract {

class ReduceBuffers {
 public:
  // A thread's tools, and the records for each partner.
  struct Worker {
    std::unique_ptr<voxelize::Voxelizer> voxelizer;
    std::vector<std::unique_ptr<RowFolder>> folders;  // one for each block
    std::vector<std::vector<std::byte>> records;      // by number of the partner
    std::int64_t walked = 0;
  };
  // A face that this rank folds, finishes, or both; in the order in which they are folded.
  struct Task {
    std::int64_t face = 0;
    std::int32_t partner = -1;  // whom to send to; -1: this rank is responsible
    std::int32_t shared = -1;   // the place in `partials` where others send to this rank, too; else -1
    std::int64_t slot = -1;     // among the results of this rank; -1: not responsible
    bool own_voxels = false;    // the bounding box meets a block of this rank
  };
  // Another rank, and how many records go there and come from there at most.
  struct Partner {
    int rank = 0;
    std::size_t to = 0;
    std::size_t from = 0;
  };

  // Tools for these options, made again only where they differ from the last ones. Throws std::bad_alloc.
  void make_workers(const Setup& setup);

  std::vector<Worker> workers;
  FaceOrder order;
  std::vector<Task> to_send;  // of faces of other ranks
  std::vector<Task> tasks;    // of the faces of this rank
  std::vector<Partner> partners;
  std::vector<std::int32_t> partner_of_rank;  // -1: none
  std::vector<Partial> partials;              // of the faces that several ranks fold
  std::vector<std::int64_t> task_of_face;     // of the faces that several ranks fold
  std::vector<Room> rooms;                    // for what partners send, by number
  std::vector<comm::KnownOutgoing> outgoing;
  std::vector<comm::KnownIncoming> incoming;

 private:
  std::string voxelizer_;
  double scale_ = 0;
  bool with_discontinuity_ = false;
};

}  // namespace footwall::extract
