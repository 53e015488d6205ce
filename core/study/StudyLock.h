// StudyLock.h - one program at a time changes a study.
//
// Both the folder and a file in it are held: the file may be removed by someone who takes it for a left-over, and not
// every file system holds folders. A file beside the study's keys is held too: copies of a study share its keys.
// Nothing is written to say who holds it: a program that changes nothing leaves the folder as it was.
//
// Thread-safety: any thread.
#pragma once

#include <filesystem>
#include <optional>
#include <unistd.h>
#include <utility>

#include "core/base/Result.h"
#include "core/safety/LockedFile.h"
#include "core/study/StudyFiles.h"

namespace tacto {

/// Held as long as the value lives.
class StudyLock {
public:
    /// Errors: Io naming the program that holds it, or that the lock cannot be taken.
    /// `besideKeys` is empty for a rehearsal, whose keys lie in its folder.
    [[nodiscard]] static Result<StudyLock> take(const StudyFiles& files, const std::filesystem::path& besideKeys);
    StudyLock(StudyLock&& other) noexcept
        : folder_(std::exchange(other.folder_, -1)), file_(std::move(other.file_)), keys_(std::move(other.keys_)) {}
    StudyLock& operator=(StudyLock&&) = delete;
    ~StudyLock() {
        if (folder_ >= 0) ::close(folder_);  // and with it the lock
    }

private:
    StudyLock(int folder, LockedFile file, std::optional<LockedFile> keys) noexcept
        : folder_(folder), file_(std::move(file)), keys_(std::move(keys)) {}
    int folder_;
    LockedFile file_;
    std::optional<LockedFile> keys_;
};

}  // namespace tacto
