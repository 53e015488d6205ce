#include "core/session/SessionLabels.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/Clock.h"
#include "core/base/JsonText.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/Printable.h"
#include "core/base/WholeFile.h"
#include "core/session/Schema.h"
#include "core/session/SessionReader.h"
#include "core/session/SessionStore.h"

namespace tacto {

namespace {

struct LabelField {
    const char* key;
    std::string SessionLabels::*text;
    std::size_t limit;
};
constexpr LabelField kLabelFields[] = {{"operator", &SessionLabels::operatorName, kLabelLimit},
                                       {"sample", &SessionLabels::sample, kLabelLimit},
                                       {"note", &SessionLabels::note, kSessionNoteLimit}};

/// Returns the differences as the body of a row; empty if there are none.
nlohmann::json changesFrom(const SessionLabels& before, const SessionLabels& now) {
    auto body = nlohmann::json::object();
    for (const auto& field : kLabelFields)
        if (before.*field.text != now.*field.text) body[field.key] = now.*field.text;
    if (before.tags != now.tags) body["tags"] = now.tags;
    return body;
}

/// Locks a file against other programs that would change it. Does not touch its content.
class FileLock {
public:
    explicit FileLock(const std::filesystem::path& path) : handle_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
    ~FileLock() {
        if (handle_ >= 0) ::close(handle_);  // closing also releases the lock
    }
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;

    /// Returns false if another program holds the lock, or if `path` now leads to another file.
    [[nodiscard]] bool take(const std::filesystem::path& path) const {
        struct stat held {};
        struct stat named {};
        return handle_ >= 0 && ::flock(handle_, LOCK_EX | LOCK_NB) == 0 && ::fstat(handle_, &held) == 0 &&
               ::stat(path.c_str(), &named) == 0 && held.st_ino == named.st_ino && held.st_dev == named.st_dev;
    }

private:
    int handle_;
};

/// A copy next to the session, removed unless it has replaced the session.
class Copy {
public:
    explicit Copy(const std::filesystem::path& of) : path_(draftBeside(of)) {}
    ~Copy() { removeDraft(path_); }
    Copy(const Copy&) = delete;
    Copy& operator=(const Copy&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

private:
    std::filesystem::path path_;
};

Result<void> append(const std::filesystem::path& file, Instant at, const nlohmann::json& body) {
    auto store = SessionStore::annotate(file);
    if (!store) return failure(store);
    if (auto row = store->addNow(kind::kAnnotation, at, "", dumpJson(body)); !row) return failure(row);
    return store->close();
}

Result<void> checkText(std::string_view title, const std::string& text, std::size_t limit) {
    if (printable(text) != text) {
        return invalid("the {} is \"{}\"; one line of text without control characters is expected", title,
                       printable(text));
    }
    if (const auto length = charactersOf(text); length > limit) {
        return invalid("the {} has {} characters; at most {} are accepted", title, length, limit);
    }
    return {};
}

Result<void> takesAnnotation(const std::filesystem::path& session, const SessionReader& reader) {
    const auto name = session.filename().string();
    const std::filesystem::path journal = session.string() + "-wal";
    std::error_code error;  // set for a name that is too long; then no journal exists
    if (!reader.closed() || std::filesystem::exists(journal, error)) {
        return fail(ErrorCode::Unsupported,
                    "session {} has no end mark: it is being recorded, or was interrupted. It is kept as it is, "
                    "without changes",
                    name);
    }
    const auto writable = std::filesystem::perms::owner_write | std::filesystem::perms::group_write |
                          std::filesystem::perms::others_write;
    if ((std::filesystem::status(session, error).permissions() & writable) == std::filesystem::perms::none) {
        return fail(ErrorCode::Io,
                    "session {} is read-only, and nothing in it was changed. Make the file writable first", name);
    }
    return {};
}

}  // namespace

Result<void> checkLabels(const SessionLabels& labels) {
    for (const auto& field : kLabelFields) {
        if (auto checked = checkText(field.key, labels.*field.text, field.limit); !checked) return checked;
    }
    const auto& tags = labels.tags;
    if (tags.size() > kMaxTags) {
        return invalid("there are {} tags; at most {} are accepted", tags.size(), kMaxTags);
    }
    for (const auto& tag : tags) {
        if (auto checked = checkText("tag", tag, kTagLimit); !checked) return checked;
        if (tag.empty() || tag.find(',') != std::string::npos) {
            return invalid("a tag is \"{}\"; a text without a comma is expected", tag);
        }
    }
    if (const auto* second = secondIn(tags)) return invalid("{}", givenTwice("the tag \"{}\"", *second));
    return {};
}

void applyLabels(const nlohmann::json& body, SessionLabels& labels) {
    for (const auto& field : kLabelFields)
        if (valueOr(body, field.key).is_string()) labels.*field.text = textOr(body, field.key);
    if (valueOr(body, "tags").is_array()) labels.tags = textsOr(body, "tags");
}

Result<void> takesLabels(const std::filesystem::path& session, const SessionReader& reader) {
    if (auto takes = takesAnnotation(session, reader); !takes) return takes;
    if (!reader.sealed()) return {};
    return fail(ErrorCode::Unsupported,
                "session {} is sealed: operator, sample, tags and note would stand in it unsealed. It is kept as it "
                "is; the study's own notes are sealed",
                session.filename().string());
}

void takeEdit(const SessionLabels& shown, const SessionLabels& edited, SessionLabels& onto) {
    applyLabels(changesFrom(shown, edited), onto);
}

Result<void> annotateSession(const std::filesystem::path& session,
                             const std::function<Result<nlohmann::json>(const SessionReader&)>& bodyFor) {
    const auto name = session.filename().string();
    const FileLock lock(session);
    const bool held = lock.take(session);  // locked before reading: changes by other programs are read and kept
    const auto reader = SessionReader::open(session);
    if (!reader) return failure(reader);
    auto body = bodyFor(*reader);
    if (!body) return failure(body);
    if (body->empty()) return {};
    if (auto takes = takesAnnotation(session, *reader); !takes) return takes;
    if (!held) {
        return fail(ErrorCode::Io,
                    "session {} is locked: another program is changing it. Nothing was changed; try again", name);
    }
    std::error_code error;
    const auto because = [&](std::string_view why) {
        return fail(ErrorCode::Io, "session {} could not be changed and is as it was: {}", name, why);
    };
    const Copy copy(session);
    removeDraft(copy.path());
    if (!std::filesystem::copy_file(session, copy.path(), error)) return because(error.message());
    (*body)["wall"] = wallTimeUtc();
    if (auto added = append(copy.path(), reader->lastAt(), *body); !added) return because(added.error().message);
    const auto written = SessionReader::open(copy.path());
    if (!written) return because(written.error().message);
    if (!written->closed() || written->chainHead() != reader->chainHead())
        return because("it was changed by another program meanwhile");
    if (auto kept = syncFile(copy.path()); !kept) return because(kept.error().message);
    std::filesystem::rename(copy.path(), session, error);
    if (error) return because(error.message());
    syncFolderOf(session);
    return {};
}

Result<SessionLabels> saveLabels(const std::filesystem::path& session, const SessionLabels& shown,
                                 const SessionLabels& edited) {
    SessionLabels changed;
    takeEdit(shown, edited, changed);
    if (auto checked = checkLabels(changed); !checked) return failure(checked);
    SessionLabels now;
    const auto added = annotateSession(session, [&](const SessionReader& reader) -> Result<nlohmann::json> {
        const auto before = reader.labels();
        if (!before) return failure(before);
        now = *before;
        takeEdit(shown, edited, now);
        auto changes = changesFrom(*before, now);
        if (changes.empty()) return changes;
        if (auto takes = takesLabels(session, reader); !takes) return failure(takes);
        return changes;
    });
    if (!added) return failure(added);
    return now;
}

}  // namespace tacto
