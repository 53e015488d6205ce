#include "core/study/StudyFiles.h"

#include "core/base/Csv.h"
#include "core/base/JsonText.h"
#include "core/base/Text.h"
#include "core/base/WholeFile.h"
#include "core/session/Digest.h"

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
/// A study is written whole: what is missing was taken away, and its default was never approved. Studies from before
/// exports had a license, or pain a ceiling, have none.
Result<void> checkWhole(const nlohmann::json& record, const std::vector<FieldInfo>& infos, const std::string& source) {
    for (const auto& info : infos) {
        if (!record.contains(info.key)) {
            if (info.key == "license" || info.key == "pain_ceiling") continue;
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

}  // namespace tacto
