// Support.h - what tests share: where files are, and scratch folders that clean up after themselves.
//
// Thread-safety: the test's own thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tacto::test {

/// The project's root folder.
[[nodiscard]] std::filesystem::path sourceDir();

/// A file or folder of ../shared/data, or nothing where a clone does not have it: then
/// `GTEST_SKIP() << kNoSharedData;`
[[nodiscard]] std::optional<std::filesystem::path> sharedData(std::string_view relative);
inline constexpr const char* kNoSharedData = "../shared/data is not here: real recordings are skipped";

/// A fresh folder, removed with everything in it when the object goes.
class ScratchDir {
public:
    ScratchDir();
    ~ScratchDir();
    ScratchDir(const ScratchDir&) = delete;
    ScratchDir& operator=(const ScratchDir&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
    /// Writes a file below the folder, its owner's alone, and returns its path.
    std::filesystem::path write(std::string_view name, std::string_view content) const;

private:
    std::filesystem::path path_;
};

/// The serial number of a unit that no other test drives, with nothing left of it on the computer.
class OwnSerial {
public:
    /// Ten characters, another each time. `begins`: at most three.
    explicit OwnSerial(std::string_view begins = "P2");
    ~OwnSerial();
    OwnSerial(const OwnSerial&) = delete;
    OwnSerial& operator=(const OwnSerial&) = delete;
    [[nodiscard]] const std::string& text() const noexcept { return text_; }

private:
    std::string text_;
};

}  // namespace tacto::test
