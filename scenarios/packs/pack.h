// Packs of numbers: one float, integer or truth for each lane, 4 to 16 wide, depending on the instructions that a source is compiled for.
// What a lane computes does not depend on the width: each operation is rounded as IEEE 754 has it, none is contracted, and no lane
// looks at another. Sources that include this are compiled once for each level (level.h), and everything here lives in a namespace named
// after it, so that no function compiled for one processor can stand in for another's: such sources include nothing else with code of its
// own.
#pragma once

#include <cstddef>
#include <cstdint>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

#ifndef FERNLICHT_LEVEL
#define FERNLICHT_LEVEL plain
#endif

namespace fernlicht::packs::FERNLICHT_LEVEL {

// PACK_CALL(max_ps, a, b): the processor's own instruction for floats.
// FERNLICHT_COUNTING: packs of one lane, without the processor's own, that count what they are asked for: operations, divisions and
// roots, look-ups of one number or two neighbours.
#if defined(FERNLICHT_COUNTING)
inline constexpr std::size_t lanes = 1;
inline thread_local long long counted_operations, counted_divisions, counted_look_ups;
#define PACK_COUNT(what) (__builtin_is_constant_evaluated() ? void() : void(++counted_##what))
#elif defined(__AVX512F__)
inline constexpr std::size_t lanes = 16;
#define PACK_REGISTER __m512
#define PACK_CALL(name, ...) Floats((FloatLanes)_mm512_##name(__VA_ARGS__))
#elif defined(__AVX2__)
inline constexpr std::size_t lanes = 8;
#define PACK_REGISTER __m256
#define PACK_CALL(name, ...) Floats((FloatLanes)_mm256_##name(__VA_ARGS__))
#else
inline constexpr std::size_t lanes = 4;
#define PACK_REGISTER __m128
#define PACK_CALL(name, ...) Floats((FloatLanes)_mm_##name(__VA_ARGS__))
#endif

#if !defined(FERNLICHT_COUNTING)
#define PACK_COUNT(what) void()
#endif

using FloatLanes = float __attribute__((vector_size(4 * lanes)));
using IntLanes = std::int32_t __attribute__((vector_size(4 * lanes)));

/// Of each lane whether; all bits of it or none.
struct Mask {
    IntLanes v;
};
inline Mask operator&&(Mask a, Mask b) { return PACK_COUNT(operations), Mask{a.v & b.v}; }
inline Mask operator||(Mask a, Mask b) { return PACK_COUNT(operations), Mask{a.v | b.v}; }
inline Mask operator!(Mask a) { return PACK_COUNT(operations), Mask{~a.v}; }

struct Ints {
    IntLanes v;

    Ints() = default;
    constexpr explicit Ints(IntLanes lanes_of_it) : v(lanes_of_it) {}
    constexpr explicit Ints(std::int32_t in_each) : v(in_each - IntLanes{}) {}
};
inline Ints operator+(Ints a, Ints b) { return PACK_COUNT(operations), Ints(a.v + b.v); }
inline Ints operator-(Ints a, Ints b) { return PACK_COUNT(operations), Ints(a.v - b.v); }
inline Ints operator*(Ints a, Ints b) { return PACK_COUNT(operations), Ints(a.v * b.v); }
inline Ints operator&(Ints a, Ints b) { return PACK_COUNT(operations), Ints(a.v & b.v); }
inline Ints operator|(Ints a, Ints b) { return PACK_COUNT(operations), Ints(a.v | b.v); }
inline Ints operator<<(Ints a, int bits) { return PACK_COUNT(operations), Ints(a.v << bits); }
inline Ints operator>>(Ints a, int bits) { return PACK_COUNT(operations), Ints(a.v >> bits); }
inline Mask operator==(Ints a, Ints b) { return PACK_COUNT(operations), Mask{a.v == b.v}; }
inline Mask operator<(Ints a, Ints b) { return PACK_COUNT(operations), Mask{a.v < b.v}; }
inline Ints select(Mask mask, Ints a, Ints b) { return PACK_COUNT(operations), Ints(mask.v ? a.v : b.v); }
inline Ints min(Ints a, Ints b) { return PACK_COUNT(operations), Ints(b.v < a.v ? b.v : a.v); }
inline Ints max(Ints a, Ints b) { return PACK_COUNT(operations), Ints(a.v < b.v ? b.v : a.v); }

struct Floats {
    FloatLanes v;

    Floats() = default;
    constexpr explicit Floats(FloatLanes lanes_of_it) : v(lanes_of_it) {}
    constexpr Floats(float in_each) : v(in_each - FloatLanes{}) {}
    /// The float nearest to it in every lane: literals of the light equations are doubles in C++.
    constexpr Floats(double in_each) : v(static_cast<float>(in_each) - FloatLanes{}) {}
};
inline constexpr Floats operator+(Floats a, Floats b) { return PACK_COUNT(operations), Floats(a.v + b.v); }
inline constexpr Floats operator-(Floats a, Floats b) { return PACK_COUNT(operations), Floats(a.v - b.v); }
inline constexpr Floats operator*(Floats a, Floats b) { return PACK_COUNT(operations), Floats(a.v * b.v); }
inline constexpr Floats operator/(Floats a, Floats b) { return PACK_COUNT(divisions), Floats(a.v / b.v); }
inline constexpr Floats operator-(Floats a) { return PACK_COUNT(operations), Floats(-a.v); }
inline Floats& operator+=(Floats& a, Floats b) { return a = a + b; }
inline Mask operator<(Floats a, Floats b) { return PACK_COUNT(operations), Mask{a.v < b.v}; }
inline Mask operator>(Floats a, Floats b) { return PACK_COUNT(operations), Mask{a.v > b.v}; }
inline Mask operator<=(Floats a, Floats b) { return PACK_COUNT(operations), Mask{a.v <= b.v}; }
inline Mask operator>=(Floats a, Floats b) { return PACK_COUNT(operations), Mask{a.v >= b.v}; }
inline Floats select(Mask mask, Floats a, Floats b) { return PACK_COUNT(operations), Floats(mask.v ? a.v : b.v); }
/// As GLSL has them: where one is not a number, the first.
#if defined(__SSE2__)
inline Floats min(Floats a, Floats b) { return PACK_CALL(min_ps, (PACK_REGISTER)b.v, (PACK_REGISTER)a.v); }
inline Floats max(Floats a, Floats b) { return PACK_CALL(max_ps, (PACK_REGISTER)b.v, (PACK_REGISTER)a.v); }
#else
inline Floats min(Floats a, Floats b) { return PACK_COUNT(operations), Floats(b.v < a.v ? b.v : a.v); }
inline Floats max(Floats a, Floats b) { return PACK_COUNT(operations), Floats(a.v < b.v ? b.v : a.v); }
#endif
inline Floats clamp(Floats x, Floats low, Floats high) { return min(max(x, low), high); }

inline Ints bits_of(Floats a) { return Ints((IntLanes)a.v); }
inline Floats floats_of_bits(Ints a) { return Floats((FloatLanes)a.v); }
inline Floats abs(Floats a) { return floats_of_bits(bits_of(a) & Ints(0x7fffffff)); }
inline Floats to_floats(Ints a) { return PACK_COUNT(operations), Floats(__builtin_convertvector(a.v, FloatLanes)); }
/// Towards 0. The number must fit.
inline Ints to_ints(Floats a) { return PACK_COUNT(operations), Ints(__builtin_convertvector(a.v, IntLanes)); }

inline Floats sqrt(Floats a) {
#if defined(__SSE2__)
    return PACK_CALL(sqrt_ps, (PACK_REGISTER)a.v);
#else
    PACK_COUNT(divisions);
    for (std::size_t i = 0; i < lanes; ++i)
        a.v[i] = __builtin_sqrtf(a.v[i]);
    return a;
#endif
}
inline Floats inversesqrt(Floats a) { return 1.0 / sqrt(a); }

inline bool any(Mask mask) {
#if defined(__AVX512F__)
    return _mm512_test_epi32_mask((__m512i)mask.v, (__m512i)mask.v) != 0;
#elif defined(__AVX2__)
    return _mm256_movemask_ps((__m256)mask.v) != 0;
#elif defined(__SSE2__)
    return _mm_movemask_ps((__m128)mask.v) != 0;
#else
    std::int32_t found = 0;
    for (std::size_t i = 0; i < lanes; ++i)
        found |= mask.v[i];
    return found != 0;
#endif
}

/// Of a mask that has one.
inline std::size_t first_lane(Mask mask) {
#if defined(__AVX512F__)
    return static_cast<std::size_t>(__builtin_ctz(_mm512_test_epi32_mask((__m512i)mask.v, (__m512i)mask.v)));
#elif defined(__AVX2__)
    return static_cast<std::size_t>(__builtin_ctz(static_cast<unsigned>(_mm256_movemask_ps((__m256)mask.v))));
#elif defined(__SSE2__)
    return static_cast<std::size_t>(__builtin_ctz(static_cast<unsigned>(_mm_movemask_ps((__m128)mask.v))));
#else
    std::size_t lane = 0;
    while (mask.v[lane] == 0)
        ++lane;
    return lane;
#endif
}

// Memory: `lanes` numbers from there on, of any alignment; or for each lane the one at its own index, which must be within the table.
inline Floats load(const float* from) {
    Floats a;
    __builtin_memcpy(&a.v, from, sizeof a.v);
    return a;
}
inline Ints load(const std::int32_t* from) {
    Ints a;
    __builtin_memcpy(&a.v, from, sizeof a.v);
    return a;
}
struct IntPair {
    Ints first, second;
};
/// Of `lanes` pairs that lie one behind another.
inline IntPair load_pairs(const std::int32_t* from) {
    const IntLanes low = load(from).v, high = load(from + lanes).v;
#if defined(FERNLICHT_COUNTING)
    return {Ints(low), Ints(high)};
#elif defined(__AVX512F__)
    return {Ints(__builtin_shufflevector(low, high, 0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30)),
            Ints(__builtin_shufflevector(low, high, 1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29, 31))};
#elif defined(__AVX2__)
    return {Ints(__builtin_shufflevector(low, high, 0, 2, 4, 6, 8, 10, 12, 14)),
            Ints(__builtin_shufflevector(low, high, 1, 3, 5, 7, 9, 11, 13, 15))};
#else
    return {Ints(__builtin_shufflevector(low, high, 0, 2, 4, 6)), Ints(__builtin_shufflevector(low, high, 1, 3, 5, 7))};
#endif
}
inline void store(Floats a, float* to) { __builtin_memcpy(to, &a.v, sizeof a.v); }
inline void store(Ints a, std::int32_t* to) { __builtin_memcpy(to, &a.v, sizeof a.v); }
inline Floats gather(const float* table, Ints index) {
#if defined(__AVX512F__)
    return PACK_CALL(i32gather_ps, (__m512i)index.v, table, 4);
#elif defined(__AVX2__)
    return PACK_CALL(i32gather_ps, table, (__m256i)index.v, 4);
#else
    PACK_COUNT(look_ups);
    Floats found;
    for (std::size_t i = 0; i < lanes; ++i)
        found.v[i] = table[index.v[i]];
    return found;
#endif
}
inline Ints gather(const std::int32_t* table, Ints index) { return bits_of(gather(reinterpret_cast<const float*>(table), index)); }

/// Two neighbours, table[index] and table[index + 1], for little more than one: a gather takes its time by the place.
struct Pair {
    Floats first, second;
};
inline Pair gather_pair(const float* table, Ints index) {
#if defined(__AVX512F__)
    const __m512i i = (__m512i)index.v;
    const __m512 low = _mm512_castpd_ps(_mm512_i32gather_pd(_mm512_castsi512_si256(i), table, 4));
    const __m512 high = _mm512_castpd_ps(_mm512_i32gather_pd(_mm512_extracti64x4_epi64(i, 1), table, 4));
    const __m512i even = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
    return {PACK_CALL(permutex2var_ps, low, even, high),
            PACK_CALL(permutex2var_ps, low, _mm512_add_epi32(even, _mm512_set1_epi32(1)), high)};
#elif defined(__AVX2__)
    const __m256i i = (__m256i)index.v;
    const double* pairs = reinterpret_cast<const double*>(table);
    const __m256 low = _mm256_castpd_ps(_mm256_i32gather_pd(pairs, _mm256_castsi256_si128(i), 4));
    const __m256 high = _mm256_castpd_ps(_mm256_i32gather_pd(pairs, _mm256_extracti128_si256(i, 1), 4));
    const auto in_order = [](__m256 a) { return Floats((FloatLanes)_mm256_permute4x64_pd(_mm256_castps_pd(a), 0xd8)); };
    return {in_order(_mm256_shuffle_ps(low, high, 0x88)), in_order(_mm256_shuffle_ps(low, high, 0xdd))};
#elif defined(FERNLICHT_COUNTING)
    return {gather(table, index), Floats(FloatLanes{table[index.v[0] + 1]})};
#else
    return {gather(table, index), gather(table + 1, index)};
#endif
}

} // namespace fernlicht::packs::FERNLICHT_LEVEL
