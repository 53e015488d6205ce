#include "core/study/StudyVerify.h"

#include <algorithm>

#include "core/base/Csv.h"
#include "core/session/SessionReader.h"
#include "core/study/LedgerEnd.h"
#include "core/study/StudyBook.h"

namespace tacto {

namespace {

namespace fs = std::filesystem;

/// Checks a study's files in one pass.
class StudyInspection {
public:
    StudyInspection(const StudyFiles& files, StudyReport& report) : files_(files), report_(report) {}

    [[nodiscard]] Result<void> run(const StudySettings& settings) {
        auto ledger = verifySession(files_.ledger());
        if (!ledger) return failure(ledger);
        report_.ledger = std::move(*ledger);
        std::erase_if(report_.ledger.notes, [](const std::string& note) {
            return note.starts_with("The session ended without closing");  // a ledger is never closed
        });
        if (report_.ledger.status != SessionStatus::Intact) {
            problem(fmt::format("the ledger is damaged: {}", report_.ledger.problems.empty()
                                                                 ? "it is not a ledger"
                                                                 : report_.ledger.problems.front()));
            return {};
        }
        const auto reader = SessionReader::open(files_.ledger());
        if (!reader) return failure(reader);
        const auto state = replay(*reader, settings.id, nullptr);
        if (!state) {
            problem(state.error().message);
            return {};
        }
        if (auto current = readStudy(files_, state->settingsSha256); !current) problem(current.error().message);
        for (const auto& session : state->sessions) check(session, *state, *reader);
        for (const auto& back : state->wentBack) report_.notes.push_back(goingBackText(back));
        if (const auto strangers = strangersIn(files_, *state)) {
            for (const auto& name : *strangers) problem(fmt::format("sessions/{} is not in the ledger", name));
        } else {
            problem(strangers.error().message);
        }
        return {};
    }

private:
    void problem(std::string text) { report_.problems.push_back(std::move(text)); }

    void check(const StudySession& session, const LedgerState& state, const SessionReader& ledger) {
        for (const auto& part : session.parts) {
            const auto path = files_.session(part.file);
            const auto noted = state.heads.find(part.file);
            const bool hasHead = noted != state.heads.end() && !noted->second.empty();
            std::error_code error;
            if (fs::symlink_status(path, error).type() == fs::file_type::not_found) {
                if (hasHead)
                    problem(fmt::format("session {} is missing", part.file));
                else
                    report_.notes.push_back(
                        fmt::format("Session {} was begun and its file never made, or it is missing.", part.file));
                continue;
            }
            auto verified = verifySession(path);
            if (!verified) {
                problem(fmt::format("session {}: {}", part.file, verified.error().message));
                continue;
            }
            if (verified->status != SessionStatus::Intact) problem(fmt::format("session {} is damaged", part.file));
            if (hasHead && verified->head != noted->second)
                problem(fmt::format("session {} has another chain head than the ledger notes", part.file));
            if (const auto begunWith = ledgerEndOf(path); begunWith && !reaches(ledger, *begunWith)) {
                problem(fmt::format("session {} was begun with row {} of a ledger, and this one has another", part.file,
                                    begunWith->row));
            }
            if (const auto reader = SessionReader::open(path); reader && !reader->sealed())
                problem(fmt::format("session {} is not sealed", part.file));
            report_.sessions.push_back({part.file, std::move(*verified)});
        }
    }

    const StudyFiles& files_;
    StudyReport& report_;
};

}  // namespace

Result<StudyReport> verifyStudy(const fs::path& folder) {
    const StudyFiles files{folder};
    if (!Study::isThere(folder)) return fail(ErrorCode::NotFound, "there is no study in {}", folder.string());
    StudyReport report;
    const auto text = readTextFile(files.settings());
    const auto settings = text ? parseStudy(*text, files.settings().string()) : failure(text);
    if (!settings) {
        if (settings.error().code == ErrorCode::Unsupported) return failure(settings);
        report.problems.push_back(settings.error().message);
        return report;
    }
    if (auto done = StudyInspection(files, report).run(*settings); !done) return failure(done);
    report.status = report.problems.empty() ? SessionStatus::Intact : SessionStatus::Damaged;
    return report;
}

}  // namespace tacto
