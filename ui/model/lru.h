// Values by key, the ones used longest ago given up first.
#pragma once
#include <cstddef>
#include <list>
#include <map>
#include <memory>
#include <utility>

namespace footwall::ui {

template <class Key, class Value>
class Lru {
 public:
  explicit Lru(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  // Null where it is not kept.
  std::shared_ptr<const Value> find(const Key& key) {
    const auto found = places_.find(key);
    if (found == places_.end()) return nullptr;
    entries_.splice(entries_.begin(), entries_, found->second);
    return found->second->value;
  }
  bool contains(const Key& key) const { return places_.contains(key); }

  // The newest stays even where it is larger than all that may be kept.
  void add(const Key& key, std::shared_ptr<const Value> value, std::size_t bytes) {
    drop(places_.find(key));
    entries_.push_front({key, std::move(value), bytes});
    places_[key] = entries_.begin();
    bytes_ += bytes;
    while (bytes_ > most_bytes_ && entries_.size() > 1) drop(places_.find(entries_.back().key));
  }

  template <class Rule>
  void drop_if(const Rule& rule) {
    for (auto place = places_.begin(); place != places_.end();) {
      const auto next = std::next(place);
      if (rule(place->first)) drop(place);
      place = next;
    }
  }
  std::size_t bytes() const { return bytes_; }

 private:
  struct Entry {
    Key key;
    std::shared_ptr<const Value> value;
    std::size_t bytes;
  };
  using Places = std::map<Key, typename std::list<Entry>::iterator>;
  void drop(typename Places::iterator place) {
    if (place == places_.end()) return;
    bytes_ -= place->second->bytes;
    entries_.erase(place->second);
    places_.erase(place);
  }

  std::size_t most_bytes_;
  std::size_t bytes_ = 0;
  std::list<Entry> entries_;  // newest first
  Places places_;
};

}  // namespace footwall::ui
