#include "core/study/StudyKeys.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/Csv.h"
#include "core/base/JsonText.h"
#include "core/base/WholeFile.h"
#include "core/seal/SealedText.h"
#include "core/seal/Secret.h"

namespace tacto {

namespace {

namespace fs = std::filesystem;

constexpr int kKeyFileVersion = 2;
constexpr int kSaysEndSince = 2;
constexpr const char* kKeyFileFormat = "tactoscope study keys";
constexpr const char* kNoSecret = "The keys of a rehearsal with virtual participants: they are not secret.";
constexpr std::size_t kIdBytes = 16;
constexpr std::size_t kCodeBytes = 32;
constexpr std::size_t kEntryBytes = kIdBytes + kCodeBytes + kKeyBytes;
constexpr std::size_t kHashDigits = 64;
constexpr std::size_t kEndBytes = 2 * sizeof(std::int64_t) + kHashDigits;

/// The seal is bound to the version too: a file with another version does not open.
std::string boundTo(const std::string& study, bool saysEnd) { return study + (saysEnd ? "\nkeys with end" : "\nkeys"); }

tl::unexpected<Error> ioError(const fs::path& file) {
    return fail(ErrorCode::Io, "the key file {} cannot be written: {}", file.string(), std::strerror(errno));
}

void put(std::span<std::byte> into, std::string_view text) { std::memcpy(into.data(), text.data(), text.size()); }

std::string textIn(std::span<const std::byte> bytes) {
    const auto* at = reinterpret_cast<const char*>(bytes.data());
    return {at, ::strnlen(at, bytes.size())};
}

void putNumber(std::span<std::byte> into, std::int64_t number) {
    for (auto& byte : into.first(sizeof number)) {
        byte = static_cast<std::byte>(number & 0xff);
        number >>= 8;
    }
}

std::int64_t numberIn(std::span<const std::byte> bytes) {
    std::uint64_t number = 0;
    for (std::size_t i = sizeof number; i-- > 0;) number = number << 8 | std::to_integer<std::uint64_t>(bytes[i]);
    return static_cast<std::int64_t>(number);
}

bool writeWhole(int file, std::string_view text) {
    while (!text.empty()) {
        const auto written = ::write(file, text.data(), text.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return false;
        text.remove_prefix(static_cast<std::size_t>(written));
    }
    return ::fsync(file) == 0;
}

/// Overwrites the content of a file that no longer has a name.
void overwrite(int file) noexcept {
    struct stat about {};
    if (::fstat(file, &about) != 0) return;
    const std::string zeros(static_cast<std::size_t>(about.st_size), '\0');
    if (::lseek(file, 0, SEEK_SET) == 0) static_cast<void>(writeWhole(file, zeros));
}

/// Replaces `file` by a file that only this account may access.
Result<void> replace(const fs::path& file, std::string_view text) {
    auto draft = file;
    draft += ".new";
    ::unlink(draft.c_str());
    const int out = ::open(draft.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (out < 0) return ioError(file);
    bool written = writeWhole(out, text);
    const int error = errno;
    ::close(out);
    const int old = ::open(file.c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW);
    written = written && ::rename(draft.c_str(), file.c_str()) == 0;
    if (!written) {
        if (old >= 0) ::close(old);
        ::unlink(draft.c_str());
        errno = error != 0 ? error : errno;
        return ioError(file);
    }
    syncFolderOf(file);
    if (old >= 0) {
        overwrite(old);
        ::close(old);
    }
    return {};
}

}  // namespace

Result<StudyKeys> StudyKeys::create(const fs::path& file, const std::string& study, const Passphrase* passphrase,
                                    const PassphraseCost& cost) {
    std::error_code error;
    if (fs::exists(file, error)) return invalid("the key file {} exists; it is never overwritten", file.string());
    if (passphrase != nullptr) {
        fs::create_directories(file.parent_path(), error);
        if (error) {
            return fail(ErrorCode::Io, "the key folder {} cannot be made: {}", file.parent_path().string(),
                        error.message());
        }
        static_cast<void>(::chmod(file.parent_path().c_str(), 0700));
    }
    StudyKeys keys(file, study);
    keys.study_ = Secret::random(kKeyBytes);
    if (passphrase != nullptr) {
        if (auto locked = keys.lockWith(*passphrase, cost); !locked) return failure(locked);
    }
    if (auto written = keys.write(); !written) return failure(written);
    return keys;
}

Result<StudyKeys> StudyKeys::open(const fs::path& file, const std::string& study, const Passphrase* passphrase,
                                  const PassphraseCost& cost) {
    std::error_code error;
    if (!fs::exists(file, error)) {
        return fail(ErrorCode::NotFound, "the key file {} of the study is not there; put it back from your copy",
                    file.string());
    }
    if (passphrase != nullptr) {
        if (auto own = isOwnFolder(file.parent_path(), "the key folder"); !own) return failure(own);
        if (auto own = isOwnFile(file, "the key file"); !own) return failure(own);
        if (fs::is_symlink(file, error)) {
            return fail(ErrorCode::NotFound,
                        "the key file {} is a link to {}; the file itself is expected in its place, or the keys there "
                        "would outlast a withdrawal",
                        file.string(), fs::read_symlink(file, error).string());
        }
    }
    const auto text = readTextFile(file);
    if (!text) return failure(text);
    const auto json = parseJson(*text, file.string());
    if (!json) return failure(json);
    if (textOr(*json, "format") != kKeyFileFormat)
        return fail(ErrorCode::ParseError, "{} is not a key file of a study", file.string());
    const auto version = countOr(*json, "version");
    if (version < 1 || version > kKeyFileVersion) {
        return fail(ErrorCode::Unsupported,
                    "the key file {} has version {}, made by a newer Tactoscope; this program "
                    "reads up to {}",
                    file.string(), version, kKeyFileVersion);
    }
    const bool saysEnd = version >= kSaysEndSince;
    if (textOr(*json, "study") != study) {
        return fail(ErrorCode::NotFound, "the key file {} belongs to study {}, not to {}", file.string(),
                    textOr(*json, "study"), study);
    }
    StudyKeys keys(file, study);
    const auto stored = bytesOfBase64(textOr(*json, passphrase != nullptr ? "sealed" : "keys"));
    if (!stored || stored->empty())
        return fail(ErrorCode::ParseError, "the key file {} is damaged: it holds no keys", file.string());
    if (passphrase == nullptr) {
        if (auto taken = keys.take(Secret(*stored), saysEnd); !taken) return failure(taken);
        return keys;
    }
    const auto salt = bytesOfBase64(textOr(*json, "salt"));
    if (!salt || salt->size() != keys.salt_.size())
        return fail(ErrorCode::ParseError, "the key file {} is damaged: its salt is not 16 bytes", file.string());
    std::ranges::copy(*salt, keys.salt_.begin());
    auto lock = passphrase->keyFor(keys.salt_, cost);
    if (!lock) return failure(lock);
    keys.lock_ = std::move(*lock);
    const auto content = openSecret(*keys.lock_, boundTo(study, saysEnd), kTextBlock, *stored);
    if (!content) {
        return fail(ErrorCode::NotFound,
                    "the passphrase does not open the key file {}: it is wrong, or the file was altered",
                    file.string());
    }
    if (auto taken = keys.take(*content, saysEnd); !taken) return failure(taken);
    return keys;
}

const StudyKeys::Entry* StudyKeys::byId(std::string_view id) const noexcept {
    const auto found = std::ranges::find(entries_, id, &Entry::id);
    return found == entries_.end() ? nullptr : &*found;
}

Result<void> StudyKeys::add(const std::string& id, const std::string& code) {
    if (id.size() != kIdBytes || code.empty() || code.size() >= kCodeBytes)
        return invalid("the code \"{}\" has {} characters; up to {} are accepted", code, code.size(), kCodeBytes - 1);
    entries_.push_back({id, code, Secret::random(kKeyBytes)});
    auto written = write();
    if (!written) entries_.pop_back();
    return written;
}

Result<void> StudyKeys::destroy(std::string_view id) {
    const auto found = std::ranges::find(entries_, id, &Entry::id);
    if (found == entries_.end()) return {};
    auto gone = std::move(*found);
    entries_.erase(found);
    auto written = write();
    if (!written) entries_.push_back(std::move(gone));  // the file still has the entry
    return written;
}

Result<void> StudyKeys::lockWith(const Passphrase& passphrase, const PassphraseCost& cost) {
    const auto salt = Secret::random(salt_.size());
    std::ranges::copy(salt.bytes(), salt_.begin());
    auto lock = passphrase.keyFor(salt_, cost);
    if (!lock) return failure(lock);
    lock_ = std::move(*lock);
    return {};
}

Result<void> StudyKeys::sealUnder(const Passphrase& passphrase, const PassphraseCost& cost) {
    if (!lock_) return fail(ErrorCode::Unsupported, "a rehearsal has no passphrase; its keys are not secret");
    const auto salt = salt_;
    auto lock = Secret(lock_->bytes());
    auto done = lockWith(passphrase, cost);
    if (done) done = write();
    if (!done) {
        salt_ = salt;
        lock_ = std::move(lock);
    }
    return done;
}

Result<void> StudyKeys::noteEnd(const LedgerEnd& end) {
    const auto before = std::exchange(end_, end);
    auto written = write();
    if (!written) end_ = before;
    return written;
}

Secret StudyKeys::content() const {
    Secret all(kKeyBytes + kEndBytes + entries_.size() * kEntryBytes);
    std::ranges::copy(study_.bytes(), all.bytes().begin());
    auto end = all.bytes().subspan(kKeyBytes, kEndBytes);
    putNumber(end, end_.row);
    putNumber(end.subspan(sizeof end_.row), end_.at.time_since_epoch().count());
    put(end.last(kHashDigits), end_.head);
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        const auto place = all.bytes().subspan(kKeyBytes + kEndBytes + i * kEntryBytes, kEntryBytes);
        put(place.first(kIdBytes), entries_[i].id);
        put(place.subspan(kIdBytes, kCodeBytes), entries_[i].code);
        std::ranges::copy(entries_[i].key.bytes(), place.subspan(kIdBytes + kCodeBytes).begin());
    }
    return all;
}

Result<void> StudyKeys::take(const Secret& content, bool saysEnd) {
    const auto bytes = content.bytes();
    const auto head = kKeyBytes + (saysEnd ? kEndBytes : 0);
    if (bytes.size() < head || (bytes.size() - head) % kEntryBytes != 0)
        return fail(ErrorCode::ParseError, "the key file {} is damaged: it holds {} bytes of keys", file_.string(),
                    bytes.size());
    study_ = Secret(bytes.first(kKeyBytes));
    if (saysEnd) {
        const auto end = bytes.subspan(kKeyBytes, kEndBytes);
        end_.row = numberIn(end);
        end_.at = std::chrono::sys_seconds(std::chrono::seconds(numberIn(end.subspan(sizeof end_.row))));
        end_.head = textIn(end.last(kHashDigits));
    }
    for (std::size_t at = head; at < bytes.size(); at += kEntryBytes) {
        const auto place = bytes.subspan(at, kEntryBytes);
        entries_.push_back({textIn(place.first(kIdBytes)), textIn(place.subspan(kIdBytes, kCodeBytes)),
                            Secret(place.subspan(kIdBytes + kCodeBytes))});
    }
    return {};
}

Result<void> StudyKeys::write() const {
    nlohmann::json json{{"format", kKeyFileFormat}, {"version", kKeyFileVersion}, {"study", studyId_}};
    const auto all = content();
    if (lock_) {
        const std::span<const std::byte> parts[] = {all.bytes()};
        json["salt"] = base64Text(salt_);
        json["sealed"] = base64Text(sealBytes(*lock_, boundTo(studyId_, true), kTextBlock, parts));
    } else {
        json["note"] = kNoSecret;
        json["keys"] = base64Text(all.bytes());
    }
    return replace(file_, dumpJson(json, 2) + "\n");
}

SessionSeal::SessionSeal(std::string study, std::string file, Secret key)
    : study_(std::move(study)), file_(std::move(file)), key_(std::move(key)) {}

std::string SessionSeal::place(std::int64_t seq, std::string_view kind) const {
    return fmt::format("{}\n{}\n{}\n{}", study_, file_, seq, kind);
}

std::string SessionSeal::sealText(std::int64_t seq, std::string_view kind, std::string_view text) const {
    return tacto::sealText(key_, place(seq, kind), text);
}

Result<std::string> SessionSeal::openText(std::int64_t seq, std::string_view kind, std::string_view sealed) const {
    return tacto::openText(key_, place(seq, kind), sealed);
}

std::vector<std::byte> SessionSeal::sealBytes(std::int64_t seq, std::string_view kind,
                                              std::span<const std::span<const std::byte>> parts) const {
    return tacto::sealBytes(key_, place(seq, kind), kChunkBlock, parts);
}

Result<std::vector<std::byte>> SessionSeal::openBytes(std::int64_t seq, std::string_view kind,
                                                      std::span<const std::byte> sealed) const {
    return tacto::openBytes(key_, place(seq, kind), kChunkBlock, sealed);
}

}  // namespace tacto
