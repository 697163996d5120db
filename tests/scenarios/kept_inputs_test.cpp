#include "tests/fuzz/replay.h"

namespace fernlicht::fuzz {

INSTANTIATE_TEST_SUITE_P(Scenarios, KeptInputs, testing::ValuesIn(scenarios_readers().begin(), scenarios_readers().end()), name_of);

} // namespace fernlicht::fuzz
