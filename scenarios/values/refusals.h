// Reading on after an error, so that all that is wrong with a file is reported at once; where nobody listens, the first error is thrown.
#pragma once

#include "scenarios/values/errors.h"

#include <functional>
#include <optional>
#include <vector>

namespace fernlicht {

/// All that `reads` refuses in this thread, in the order in which it was met, each once. Readers that use EachRead go on after an error and
/// throw at their end, so that nobody works with what was read by half.
std::vector<InputError> all_refusals(const std::function<void()>& reads);

/// How many were met so far; 0 where nobody listens.
std::size_t refusals_met();

/// Notes what is wrong and does no harm to what else is read, and returns; throws it where nobody listens. `meant`: the key path that was
/// meant, so that it is not called missing, too.
void refuse_and_go_on(const InputError& error, const std::string& meant = {});

/// Things of which none needs another: each is read, whatever is wrong with the others.
class EachRead {
  public:
    /// Whether it could be read.
    template <class Read> bool operator()(Read&& read) {
        try {
            read();
            return true;
        } catch (const InputError& error) {
            note(error);
            return false;
        }
    }
    bool failed() const { return first_.has_value(); }
    /// Throws the first of what was refused.
    void end() const;

  private:
    void note(const InputError& error); ///< throws on where nobody listens
    std::optional<InputError> first_;
};

} // namespace fernlicht
