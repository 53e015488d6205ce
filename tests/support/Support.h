// Support.h - helpers shared by all tests: paths of files, and temporary folders that remove themselves.
//
// Thread-safety: the test's own thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tacto::test {

/// Returns the project's root folder.
[[nodiscard]] std::filesystem::path sourceDir();

/// Returns a file or folder in ../shared/data, or nothing if this clone does not have it; then use `GTEST_SKIP() <<
/// kNoSharedData;`
[[nodiscard]] std::optional<std::filesystem::path> sharedData(std::string_view relative);
inline constexpr const char* kNoSharedData = "../shared/data is not here: real recordings are skipped";

/// A new folder, removed with its contents by the destructor.
class ScratchDir {
public:
    ScratchDir();
    ~ScratchDir();
    ScratchDir(const ScratchDir&) = delete;
    ScratchDir& operator=(const ScratchDir&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
    /// Writes a file in the folder, accessible only to its owner, and returns its path.
    std::filesystem::path write(std::string_view name, std::string_view content) const;

private:
    std::filesystem::path path_;
};

/// A serial number that no other test uses; removes everything that is stored for it on this computer.
class OwnSerial {
public:
    /// Makes ten characters, different each time, beginning with `begins` (at most three characters).
    explicit OwnSerial(std::string_view begins = "P2");
    ~OwnSerial();
    OwnSerial(const OwnSerial&) = delete;
    OwnSerial& operator=(const OwnSerial&) = delete;
    [[nodiscard]] const std::string& text() const noexcept { return text_; }

private:
    std::string text_;
};

}  // namespace tacto::test
