// The places of the bits of a word, as a list. Included after highway.h, once per instruction set.
#if defined(FOOTWALL_ISOSURFACE_LIST_BITS) == defined(HWY_TARGET_TOGGLE)
#ifdef FOOTWALL_ISOSURFACE_LIST_BITS
#undef FOOTWALL_ISOSURFACE_LIST_BITS
#else
#define FOOTWALL_ISOSURFACE_LIST_BITS
#endif

#include <hwy/highway.h>

#include <bit>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace footwall::isosurface::detail::HWY_NAMESPACE {

// Writes the places of the bits, ascending, `first` for bit 0, and returns where the next one goes; writes up
// to kListSlack more than there are.
#if HWY_TARGET == HWY_AVX3_DL
// Without a branch that depends on how many there are, up to sixteen: most words have few, and none as often.
template <class Number>
HWY_INLINE Number* list_bits(std::uint64_t bits, Number first, Number* HWY_RESTRICT into) {
  static_assert(sizeof(Number) == sizeof(std::uint32_t));
  alignas(64) static constexpr std::uint8_t kPlaces[64] = {
      0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21,
      22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 43,
      44, 45, 46, 47, 48, 49, 50, 51, 52, 53, 54, 55, 56, 57, 58, 59, 60, 61, 62, 63};
  const int count = std::popcount(bits);
  const __m512i base = _mm512_set1_epi32(static_cast<int>(first));
  const __m512i places = _mm512_maskz_compress_epi8(bits, _mm512_load_si512(kPlaces));
  _mm512_storeu_si512(into, _mm512_add_epi32(base, _mm512_cvtepu8_epi32(_mm512_castsi512_si128(places))));
  if (HWY_UNLIKELY(count > 16)) {
    const auto store = [&](int from, __m128i sixteen) HWY_ATTR {
      _mm512_storeu_si512(into + from, _mm512_add_epi32(base, _mm512_cvtepu8_epi32(sixteen)));
    };
    store(16, _mm512_extracti32x4_epi32(places, 1));
    if (count > 32) store(32, _mm512_extracti32x4_epi32(places, 2));
    if (count > 48) store(48, _mm512_extracti32x4_epi32(places, 3));
  }
  return into + count;
}
#else
template <class Number>
HWY_INLINE Number* list_bits(std::uint64_t bits, Number first, Number* HWY_RESTRICT into) {
  if (bits == 0) return into;
  Number* const end = into + std::popcount(bits);
  // Most words have few: two at a time, without asking how many there are, spares mispredicted branches.
  while (true) {
    for (int n = 0; n < 2; ++n) {
      into[n] = first + static_cast<Number>(std::countr_zero(bits));
      bits &= bits - 1;
    }
    if (bits == 0) return end;
    into += 2;
  }
}
#endif

}  // namespace footwall::isosurface::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
