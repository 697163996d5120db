#include "tests/fuzz/replay.h"

namespace fernlicht::fuzz {

INSTANTIATE_TEST_SUITE_P(Runner, KeptInputs, testing::ValuesIn(runner_readers().begin(), runner_readers().end()), name_of);

} // namespace fernlicht::fuzz
