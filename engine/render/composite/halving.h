// Who merges pictures with whom, and which rows stay with whom: plain arithmetic, alike on every rank.
// Based on: seed 000, section 5 (the merge in log2 steps in which half of what is left changes hands);
// differs in that any number of ranks is possible: where it is no power of two, the ranks beyond the largest
// one below first give what they have to partners below, and are done.
#pragma once

namespace footwall::render {

struct Rows {
  int begin = 0;
  int end = 0;
  int count() const { return end - begin; }
  friend bool operator==(const Rows&, const Rows&) = default;
};

class Halving {
 public:
  explicit Halving(int ranks);

  // Step 0 is the one in which ranks beyond core() give; in step n > 0 a rank's partner differs in bit n - 1.
  int steps() const { return steps_; }
  // The largest power of two that is not above the number of ranks: those that end with a part of the
  // picture.
  int core() const { return core_; }
  // -1: nobody.
  int partner(int rank, int step) const;
  // In step 0 alone: gives everything and gets nothing.
  bool gives(int rank) const { return rank >= core_; }
  // What a rank still holds of `whole` when so many steps are done. Rows may run out.
  Rows rows(int rank, int steps_done, Rows whole) const;

 private:
  int ranks_;
  int core_ = 1;
  int steps_ = 1;
};

}  // namespace footwall::render
