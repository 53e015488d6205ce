#include "core/study/NewStudy.h"

#include "core/base/WholeFile.h"
#include "core/session/Digest.h"
#include "core/session/Ledger.h"
#include "core/study/LedgerRows.h"
#include "core/study/StudyKeys.h"

namespace tacto {

namespace {

namespace fs = std::filesystem;

/// Goes with its owner unless it was kept.
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

/// study.json, ledger and sessions/ in `files.folder`, which is there.
Result<void> layOut(const StudyFiles& files, const StudySettings& settings, std::chrono::sys_seconds now) {
    std::error_code error;
    if (!fs::create_directory(files.sessions(), error))
        return fail(ErrorCode::Io, "{} cannot be made: {}", files.sessions().string(), error.message());
    SessionAbout about;
    about.programVersion = TACTOSCOPE_VERSION;
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
