// How wide packs are on this processor, chosen when the program runs. All levels compute the same bits.
// FERNLICHT_WIDEST before a function whose loops the compiler makes wide by itself: compiled for several widths, the right one chosen when
// the program starts; sanitizers cannot instrument that. No width changes a bit: nothing is summed across a vector, nothing is contracted.
#pragma once

#include <cstddef>
#include <vector>

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define FERNLICHT_WIDEST __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define FERNLICHT_WIDEST
#endif

namespace fernlicht::packs {

/// What a source of packs is compiled for: what every processor of the kind has, then more (CMakeLists.txt, fernlicht_packs).
enum class Level { plain, avx2, avx512 };

inline constexpr std::size_t lanes_of(Level level) { return std::size_t{4} << static_cast<int>(level); }
/// Of all levels: memory that packs read is padded to a multiple of it.
inline constexpr std::size_t most_lanes = 16;

inline bool runs_here(Level level) {
#if defined(__x86_64__)
    return level == Level::plain || (level == Level::avx2 && __builtin_cpu_supports("avx2") != 0) ||
           (level == Level::avx512 && __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512bw") != 0 &&
            __builtin_cpu_supports("avx512dq") != 0 && __builtin_cpu_supports("avx512vl") != 0);
#else
    return level == Level::plain;
#endif
}

/// Those of this processor, the widest last.
inline std::vector<Level> levels_here() {
    std::vector<Level> levels;
    for (const Level level : {Level::plain, Level::avx2, Level::avx512})
        if (runs_here(level))
            levels.push_back(level);
    return levels;
}

inline Level widest_level() {
    static const Level widest = levels_here().back();
    return widest;
}

// AT_EACH_LEVEL(declaration;) within namespace packs: a function that a source of packs defines in the namespace of its level.
// AT_LEVEL(level, function): that of this level.
#if defined(__x86_64__)
#define AT_EACH_LEVEL(...)                                                                                                                 \
    namespace plain {                                                                                                                      \
    __VA_ARGS__                                                                                                                            \
    }                                                                                                                                      \
    namespace avx2 {                                                                                                                       \
    __VA_ARGS__                                                                                                                            \
    }                                                                                                                                      \
    namespace avx512 {                                                                                                                     \
    __VA_ARGS__                                                                                                                            \
    }
#define AT_LEVEL(level, function)                                                                                                          \
    ((level) == packs::Level::avx512 ? packs::avx512::function                                                                             \
     : (level) == packs::Level::avx2 ? packs::avx2::function                                                                               \
                                     : packs::plain::function)
#else
#define AT_EACH_LEVEL(...)                                                                                                                 \
    namespace plain {                                                                                                                      \
    __VA_ARGS__                                                                                                                            \
    }
#define AT_LEVEL(level, function) packs::plain::function
#endif

} // namespace fernlicht::packs
