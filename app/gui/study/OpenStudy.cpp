#include "app/gui/study/OpenStudy.h"

#include <utility>

#include "app/gui/theme/Text.h"
#include "app/run/Shipped.h"
#include "core/analysis/identification/IdentificationJson.h"
#include "core/base/JsonText.h"
#include "core/base/ProgramVersion.h"
#include "core/base/Words.h"
#include "core/pilot/PilotRecord.h"
#include "core/session/SessionReader.h"
#include "core/sharing/results/StudyFigures.h"

namespace tacto::gui {

namespace {

/// Returns a session's outcome, read from its files with the study's key: verdict, reasons and results as recorded, and
/// whether the session was simulated; all else is empty. A stopped session may have only the reason
/// of its end. Errors: kGateRefused for an unfinished session;
/// NotFound if its files hold no result; as Study::part().
Result<RunResult> recordedResult(const Study& study, const StudySession& session) {
    if (session.state == StudySessionState::Unfinished)
        return fail(kGateRefused, "session {} is unfinished; only one that has ended has a result", session.number);
    RunResult result;
    bool found = false;
    for (const auto& part : session.parts) {
        const auto file = study.part(part.file);
        if (!file) return failure(file);
        if (!*file) continue;  // planned, but never begun
        auto verdicts = (*file)->verdicts();
        if (!verdicts) return failure(verdicts);
        const auto& about = (*file)->about();
        result.simulated = result.simulated || about.simulated;
        result.devices = about.devices;
        result.session = study.pathOf(part.file);
        if (verdicts->empty()) continue;
        auto& last = verdicts->back();
        result.outcome.verdict = valueFor(kScriptVerdicts, last.verdict).value_or(ScriptVerdict::None);
        result.outcome.reasons = std::move(last.reasons);
        result.outcome.results = std::move(last.results);
        found = true;
    }
    if (!found && session.state == StudySessionState::Stopped) {
        const auto rows = study.events(session);
        if (!rows) return failure(rows);
        for (const auto& each : *rows)
            if (each.name == row::kSessionEnd) result.outcome.reasons = {textOr(each.body, "why")};
        result.outcome.reasons.push_back(fmt::format("Stopped; {} answers are on disk.", session.answered));
        return result;
    }
    if (!found)
        return fail(ErrorCode::NotFound, "the record of session {} of {} holds no result", session.number,
                    session.code);
    return result;
}

Result<StudyShown> shownOf(const Study& study) {
    auto record = readStudyRecord(study);
    if (!record) return failure(record);
    leaveOutUnfinished(*record);
    StudyShown shown;
    for (const auto& [basis, part] : byBasis(*record)) {
        const auto found = studyFigures(basis, part);
        if (!found) return failure(found);
        shown.parts.push_back(toJson(*found));
        shown.parts.back()["basis"] = nameOf(basis);
    }
    auto figures = pilotFigures(*record);
    if (!figures) return failure(figures);
    shown.figures = std::move(*figures);
    return shown;
}

}  // namespace

OpenStudy::OpenStudy(QObject* parent, Study::Surroundings around) : QObject(parent), around_(std::move(around)) {}

Profile OpenStudy::profile() const { return profile_ ? profile_() : shippedProfile().value_or(Profile()); }

Result<OpenStudy::Look> OpenStudy::look(const QString& folder) const {
    const auto seen = Study::open(folder.toStdString(), nullptr, Study::Access::Read, around_);
    if (!seen) return failure(seen);
    return Look{qtext(seen->settings().title), !seen->isRehearsal()};
}

void OpenStudy::begin(Make make) {
    study_.reset();
    work_.take([make = std::move(make)](const WorkPort&) { return make(); },
               [this](Result<Study> made) {
                   if (made) {
                       study_.emplace(std::move(*made));
                   } else {
                       folder_.clear();
                       passphrase_.reset();
                   }
                   emit changed();
                   if (made)
                       emit opened();
                   else
                       emit refused(sentence(made.error()));
               });
    emit changed();
}

void OpenStudy::open(const QString& folder, std::shared_ptr<const Secret> passphrase) {
    folder_ = folder;
    passphrase_ = std::move(passphrase);
    begin([place = folder.toStdString(), words = passphrase_, around = around_]() -> Result<Study> {
        if (!words) return Study::open(place, nullptr, Study::Access::Change, around);
        const auto opens = Passphrase::from(*words);
        if (!opens) return failure(opens);
        return Study::open(place, &*opens, Study::Access::Change, around);
    });
}

void OpenStudy::create(const QString& folder, const StudySettings& settings, std::shared_ptr<const Secret> passphrase) {
    folder_ = folder;
    passphrase_ = std::move(passphrase);
    begin([place = folder.toStdString(), settings, words = passphrase_, around = around_]() -> Result<Study> {
        const auto seals = Passphrase::from(*words);
        if (!seals) return failure(seals);
        return Study::create(place, settings, *seals, around);
    });
}

void OpenStudy::giveUpOpening() {
    if (!busy()) return;
    close();
    // This empty work replaces the opening under way, so that its result is dropped.
    work_.start([](const WorkPort&) { return Result<void>(); }, [this](const Result<void>&) { emit changed(); });
}

void OpenStudy::close() {
    study_.reset();
    passphrase_.reset();
    folder_.clear();
    emit changed();
}

void OpenStudy::lend() {
    study_.reset();
    emit changed();
}

void OpenStudy::takeBack() {
    if (!folder_.isEmpty() && !study_) open(folder_, passphrase_);
}

void OpenStudy::changePassphrase(std::shared_ptr<const Secret> next) {
    if (study() == nullptr) return;
    work_.start(
        [this, next](const WorkPort&) -> Result<void> {
            const auto seals = Passphrase::from(*next);
            return seals ? study_->changePassphrase(*seals) : failure(seals);
        },
        [this, next](const Result<void>& done) {
            if (done) passphrase_ = next;
            emit changed();
            if (done)
                emit passphraseChanged();
            else
                emit refused(sentence(done.error()));
        });
    emit changed();
}

void OpenStudy::exportBids(const QString& place, const BidsWith& with) {
    if (study() == nullptr) return;
    work_.start([this, with, out = place.toStdString()](
                    const WorkPort&) { return tacto::exportBids(*study_, with, out, programVersion().version); },
                [this, place](const Result<void>& done) {
                    emit changed();
                    if (done)
                        emit exported(place);
                    else
                        emit refused(sentence(done.error()));
                });
    emit changed();
}

void OpenStudy::readResults() {
    if (study() == nullptr) return;
    work_.take([this](const WorkPort&) { return shownOf(*study_); },
               [this](const Result<StudyShown>& read) {
                   emit changed();
                   if (read)
                       emit resultsRead(*read);
                   else
                       emit refused(sentence(read.error()));
               });
    emit changed();
}

void OpenStudy::readResult(const QString& id) {
    if (study() == nullptr) return;
    const auto session = study_->session(id.toStdString());
    if (!session) return emit refused(sentence(session.error()));
    work_.take([this, session = *session](const WorkPort&) { return recordedResult(*study_, session); },
               [this](const Result<RunResult>& read) {
                   emit changed();
                   if (read)
                       emit resultRead(*read);
                   else
                       emit refused(sentence(read.error()));
               });
    emit changed();
}

}  // namespace tacto::gui

#include "moc_OpenStudy.cpp"
