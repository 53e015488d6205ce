#include "core/study/StudyFiles.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>

#include "core/base/Csv.h"
#include "core/base/JsonText.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/ProgramVersion.h"
#include "core/base/WholeFile.h"
#include "core/session/Digest.h"
#include "core/session/Ledger.h"
#include "core/study/LedgerRows.h"
#include "core/study/StudyKeys.h"

namespace tacto {

namespace {

constexpr int kStudyVersion = 1;

std::filesystem::path draftOf(const StudyFiles& files) {
    auto draft = files.settings();
    return draft += ".new";
}

}  // namespace

std::filesystem::path StudyFiles::session(std::string_view file) const {
    return sessions() / fmt::format("{}.tacto", file);
}

std::string studyText(const StudySettings& settings) {
    auto json = studyFields().write(settings);
    json["version"] = kStudyVersion;
    if (settings.kind == StudyKind::Rehearsal)
        json["note"] = "A rehearsal: its keys lie beside this file and are not secret.";
    return dumpJson(json, 2) + "\n";
}

namespace {
/// study.json is always written with all its fields: a missing field was removed, and its default was never approved.
/// Only what older studies do not have may be missing.
Result<void> checkWhole(const nlohmann::json& record, const std::vector<FieldInfo>& infos, const std::string& source) {
    for (const auto& info : infos) {
        if (!record.contains(info.key)) {
            constexpr std::string_view kSince[] = {"license", "pain_ceiling", "age_min", "exclusions", "words"};
            if (std::ranges::find(kSince, info.key) != std::end(kSince)) continue;
            return fail(ErrorCode::ParseError, "{}: \"{}\" is missing; a study has all its settings", source, info.key);
        }
        if (!record[info.key].is_object()) continue;
        if (auto whole = checkWhole(record[info.key], info.members, source); !whole) return whole;
    }
    return {};
}
}  // namespace

Result<StudySettings> parseStudy(std::string_view text, const std::string& source) {
    auto json = parseJson(text, source);
    if (!json) return failure(json);
    if (auto object = expectObject(*json, source); !object) return failure(object);
    const auto version = valueOr(*json, "version");
    if (!version.is_number_unsigned())
        return fail(ErrorCode::ParseError, "{} states no version; it is not one of Tactoscope's studies", source);
    if (version.get<std::uint64_t>() > kStudyVersion) {
        return fail(ErrorCode::Unsupported,
                    "{} has version {}, made by a newer Tactoscope; this program reads up to {}", source,
                    version.get<std::uint64_t>(), kStudyVersion);
    }
    json->erase("version");
    json->erase("note");
    if (auto whole = checkWhole(*json, studyFields().infos(), source); !whole) return failure(whole);
    auto settings = studyFields().read(*json, RecordPlace{.file = source});
    if (!settings) return tl::unexpected<Error>(asParseError(settings.error()));
    if (!isHex(settings->id, 16))
        return fail(ErrorCode::ParseError, "{}: the id is \"{}\"; 16 hexadecimal digits are expected", source,
                    settings->id);
    return settings;
}

Result<void> draftStudy(const StudyFiles& files, std::string_view text) {
    const auto draft = draftOf(files);
    auto out = FileOut::create(draft);
    auto written = out ? out->write(text) : failure(out);
    if (written) written = syncFile(draft);
    return namedAs(files.settings(), std::move(written));
}

Result<void> publishStudy(const StudyFiles& files) {
    std::error_code error;
    std::filesystem::rename(draftOf(files), files.settings(), error);
    if (error) return fail(ErrorCode::Io, "{} cannot be replaced: {}", files.settings().string(), error.message());
    syncFolderOf(files.settings());
    return {};
}

Result<std::string> readStudy(const StudyFiles& files, std::string_view sha256) {
    auto text = readTextFile(files.settings());
    if (text && sha256Hex(*text) == sha256) return text;
    if (auto draft = readTextFile(draftOf(files)); draft && sha256Hex(*draft) == sha256) return draft;
    if (!text) return text;
    return fail(ErrorCode::ParseError,
                "{} is not what the ledger says: it was changed outside the program; put it back from your copy",
                files.settings().string());
}

bool liesInside(const std::filesystem::path& path, const std::filesystem::path& folder) {
    std::error_code error;
    const auto whole = std::filesystem::weakly_canonical(std::filesystem::absolute(path, error), error);
    const auto within = std::filesystem::weakly_canonical(std::filesystem::absolute(folder, error), error);
    const auto [end, ignored] = std::mismatch(within.begin(), within.end(), whole.begin(), whole.end());
    return end == within.end();
}

namespace fs = std::filesystem;

Result<StudyLock> StudyLock::take(const StudyFiles& files, const fs::path& besideKeys) {
    constexpr std::size_t kLockBytes = 1;
    const auto isOpen = [&](const fs::path& held) {
        const auto holder = lockHolder(held, "FLOCK");
        return fail(ErrorCode::Io, "{} in {} is open in {}; end that first. Nothing was changed",
                    held == besideKeys ? "a copy of the study" : "the study", files.folder.string(),
                    holder ? programOf(*holder) : "another program");
    };
    const int folder = ::open(files.folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const auto closed = [folder](tl::unexpected<Error> error) {
        if (folder >= 0) ::close(folder);
        return error;
    };
    if (folder >= 0 && ::flock(folder, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        return closed(isOpen(files.folder));
    const auto refused = [&](const fs::path& file, const LockedFile::Refused& why) {
        if (why.why == LockedFile::Refusal::Held) return closed(isOpen(file));
        const bool failed = why.why == LockedFile::Refusal::Failed;
        return closed(fail(ErrorCode::Io,
                           "the study in {} cannot be opened for changes: its lock {} cannot be taken: {}",
                           files.folder.string(), file.string(),
                           failed ? std::strerror(why.error) : "it is a link, a pipe or has a second name"));
    };
    auto locked = LockedFile::open(files.lock(), kLockBytes, 0600);
    if (!locked) return refused(files.lock(), locked.error());
    std::error_code error;
    if (besideKeys.empty() || !fs::is_directory(besideKeys.parent_path(), error))
        return StudyLock(folder, std::move(*locked), std::nullopt);
    auto keys = LockedFile::open(besideKeys, kLockBytes, 0600);
    if (!keys) return refused(besideKeys, keys.error());
    return StudyLock(folder, std::move(*locked), std::move(*keys));
}

namespace {

namespace fs = std::filesystem;

/// A path that is removed with this object unless it was kept.
struct Draft {
    explicit Draft(fs::path made) : path(std::move(made)) {}
    ~Draft() {
        std::error_code ignored;
        if (!path.empty()) fs::remove_all(path, ignored);
    }
    Draft(const Draft&) = delete;
    Draft& operator=(const Draft&) = delete;
    fs::path path;
};

/// Writes study.json, ledger and sessions/ to `files.folder`, which must exist.
Result<void> layOut(const StudyFiles& files, const StudySettings& settings, std::chrono::sys_seconds now) {
    std::error_code error;
    if (!fs::create_directory(files.sessions(), error))
        return fail(ErrorCode::Io, "{} cannot be made: {}", files.sessions().string(), error.message());
    SessionAbout about;
    about.programVersion = programVersion().version;
    about.protocol = "study ledger";
    about.wallStart =
        fmt::format("{}T00:00:00Z", dateText(std::chrono::year_month_day(std::chrono::floor<std::chrono::days>(now))));
    auto made = Ledger::create(files.ledger(), about, now);
    if (!made) return failure(made);
    const auto text = studyText(settings);
    if (auto row = made->append(now, ledger::kStudy, settingsRow(settings, text)); !row) return failure(row);
    if (auto drafted = draftStudy(files, text); !drafted) return drafted;
    return publishStudy(files);
}

Result<void> takeFolder(const StudyFiles& files) {
    std::error_code error;
    if (Study::isThere(files.folder))
        return fail(ErrorCode::Unsupported, "{} holds a study; a new one needs a folder of its own",
                    files.folder.string());
    if (fs::exists(files.folder, error) &&
        (!fs::is_directory(files.folder, error) || !fs::is_empty(files.folder, error)))
        return fail(ErrorCode::Unsupported, "{} is there already; a new study needs an empty folder or a new one",
                    files.folder.string());
    return {};
}

}  // namespace

fs::path keyFileOf(const StudyFiles& files, const StudySettings& settings, const Study::Surroundings& around) {
    return settings.kind == StudyKind::Rehearsal ? files.keys() : around.keyFolder / (settings.id + ".json");
}

Result<void> keysLieOutside(const StudyFiles& files, const Study::Surroundings& around) {
    if (!liesInside(around.keyFolder, files.folder)) return {};
    return fail(ErrorCode::Unsupported,
                "the key folder {} lies inside the study folder {}; keys beside what they open protect nothing, so "
                "another place is needed",
                around.keyFolder.string(), files.folder.string());
}

StudySettings asRehearsal(StudySettings settings, CalibrationDate today) {
    constexpr int kAsManyAsWanted = 10'000;
    settings.kind = StudyKind::Rehearsal;
    if (settings.title.empty()) settings.title = "Rehearsal";
    if (settings.consentVersion.empty()) settings.consentVersion = "rehearsal";
    settings.participantsMax = settings.sessionsMax = kAsManyAsWanted;
    auto& approval = settings.approval;
    if (approval.reference.empty()) {
        approval.reference = "rehearsal";
        approval.from = today;
        approval.expires = {today.year() + std::chrono::years(50), std::chrono::January, std::chrono::day(1)};
    }
    return settings;
}

nlohmann::json settingsRow(const StudySettings& settings, std::string_view text) {
    return {{"settings", studyFields().write(settings)}, {"sha256", sha256Hex(text)}};
}

Result<void> makeStudy(const StudyFiles& files, const StudySettings& settings, const Passphrase* passphrase,
                       const Study::Surroundings& around) {
    if (auto taken = takeFolder(files); !taken) return taken;
    std::error_code error;
    const auto parent = fs::absolute(files.folder).parent_path();
    fs::create_directories(parent, error);
    const StudyFiles draft{draftBeside(fs::absolute(files.folder))};
    fs::remove_all(draft.folder, error);
    if (!fs::create_directory(draft.folder, error))
        return fail(ErrorCode::Io, "{} cannot be made: {}", files.folder.string(), error.message());
    Draft made(draft.folder);
    if (auto laid = layOut(draft, settings, around.time->wall()); !laid) return laid;
    const bool rehearsal = settings.kind == StudyKind::Rehearsal;
    const auto keyFile = keyFileOf(rehearsal ? draft : files, settings, around);
    auto keys = StudyKeys::create(keyFile, settings.id, passphrase, around.cost);
    if (!keys) return failure(keys);
    fs::rename(draft.folder, files.folder, error);
    if (error) {
        if (!rehearsal) fs::remove(keyFile);
        return fail(ErrorCode::Io, "{} cannot be made: {}", files.folder.string(), error.message());
    }
    made.path.clear();
    syncFolderOf(files.folder);
    return {};
}

}  // namespace tacto
