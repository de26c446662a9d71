// What ranks that draw one picture together have to tell each other, so that the drawing itself knows nothing
// of messages. Every call but rank() and size() is made by all ranks, in the same order.
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/render/depth_pyramid.h"

namespace footwall::isosurface {

class Ranks {
 public:
  Ranks() = default;
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;
  virtual ~Ranks() = default;

  virtual int rank() const = 0;
  virtual int size() const = 0;
  // Runs work that tells nobody anything; where it throws on any rank, all throw.
  virtual void together(const std::function<void()>& work) = 0;
  // Of all ranks, on all of them, element by element.
  virtual void least(std::span<render::CoarseDepth> values) = 0;
  virtual void most(std::span<std::int64_t> values) = 0;
  virtual void sum(std::span<std::int64_t> values) = 0;
  virtual void any(std::span<std::uint64_t> bits) = 0;
  // All ranks' values, rank after rank; each has as many.
  virtual std::vector<std::int64_t> all(std::span<const std::int64_t> values) = 0;
  // bytes[r] goes to rank r; returns what each rank sent here.
  virtual std::vector<std::vector<std::byte>> exchange(std::vector<std::vector<std::byte>> bytes) = 0;
};

// The one rank that there is.
class OneRank final : public Ranks {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  void together(const std::function<void()>& work) override { work(); }
  void least(std::span<render::CoarseDepth>) override {}
  void most(std::span<std::int64_t>) override {}
  void sum(std::span<std::int64_t>) override {}
  void any(std::span<std::uint64_t>) override {}
  std::vector<std::int64_t> all(std::span<const std::int64_t> values) override {
    return {values.begin(), values.end()};
  }
  std::vector<std::vector<std::byte>> exchange(std::vector<std::vector<std::byte>> bytes) override {
    return bytes;
  }
};

}  // namespace footwall::isosurface
