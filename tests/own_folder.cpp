// What tests and the programs they start write goes below build/, and is gone when the test is.
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

namespace {

class OwnFolder {
  public:
    // A test program that a test starts (a death test, which ends without destructors) writes into the folder of the one that started it.
    OwnFolder() {
        const char* of_parent = std::getenv("TMPDIR");
        if (of_parent && std::string_view(of_parent).starts_with(FERNLICHT_TEST_FILES "/"))
            return;
        std::filesystem::create_directories(FERNLICHT_TEST_FILES);
        path_ = FERNLICHT_TEST_FILES "/XXXXXX";
        if (!::mkdtemp(path_.data()))
            std::abort();
        ::setenv("TMPDIR", path_.c_str(), 1);
        ::setenv("TEST_TMPDIR", path_.c_str(), 1);
        ::setenv("XDG_CACHE_HOME", path_.c_str(), 1);                             // the store of cells
        ::setenv("MESA_SHADER_CACHE_DIR", FERNLICHT_TEST_FILES "/../shaders", 0); // compiled shaders stay for the next run
    }
    ~OwnFolder() {
        std::error_code ignored;
        if (!path_.empty())
            std::filesystem::remove_all(path_, ignored);
    }
    OwnFolder(const OwnFolder&) = delete;
    OwnFolder& operator=(const OwnFolder&) = delete;

  private:
    std::string path_;
};

const OwnFolder own_folder;

} // namespace
