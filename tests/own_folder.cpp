// What tests and the programs they start write goes below build/, and is gone when the test is.
#include <cstdlib>
#include <filesystem>
#include <string>

namespace {

class OwnFolder {
  public:
    OwnFolder() {
        std::filesystem::create_directories(FERNLICHT_TEST_FILES);
        path_ = FERNLICHT_TEST_FILES "/XXXXXX";
        if (!::mkdtemp(path_.data()))
            std::abort();
        ::setenv("TMPDIR", path_.c_str(), 1);
        ::setenv("TEST_TMPDIR", path_.c_str(), 1);
    }
    ~OwnFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    OwnFolder(const OwnFolder&) = delete;
    OwnFolder& operator=(const OwnFolder&) = delete;

  private:
    std::string path_;
};

const OwnFolder own_folder;

} // namespace
