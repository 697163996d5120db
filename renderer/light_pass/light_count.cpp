// The light pass compiled once more, over packs that count what they are asked for: the counts are the text's own.
#define FERNLICHT_COUNTING
#define FERNLICHT_LEVEL counting
#undef __AVX512F__
#undef __AVX2__
#undef __SSE2__
#include "renderer/light_pass/light_pass_packs.cpp" // NOLINT(bugprone-suspicious-include)

namespace fernlicht::packs::counting {

PassCounts count_rows(const PassPicture& picture, void* triangles, std::int32_t first_row, std::int32_t end_row) {
    counted_operations = counted_divisions = counted_look_ups = 0;
    light_rows(picture, triangles, first_row, end_row);
    return {counted_operations, counted_divisions, counted_look_ups};
}

} // namespace fernlicht::packs::counting
