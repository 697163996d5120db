// A temporary folder for work whose results end up elsewhere.
#pragma once

#include "runner/files/durable_files.h"

namespace fernlicht {

/// A new folder below another, which no process of any machine has but this; removed with all that is in it when this goes. Locked, so that
/// those that a killed process left can be told. Throws DeviceError.
class Workplace {
  public:
    Workplace(const std::filesystem::path& below, const std::string& begins_with);
    Workplace(const Workplace&) = delete;
    Workplace& operator=(const Workplace&) = delete;
    ~Workplace();

    const std::filesystem::path& folder() const { return folder_; }

  private:
    std::filesystem::path folder_;
    FolderLock lock_;
};

} // namespace fernlicht
