#include "app/gui/study/OpenStudy.h"

#include <utility>

#include "app/gui/study/RecordedResult.h"
#include "app/gui/theme/Text.h"
#include "app/run/Shipped.h"
#include "core/sharing/results/StudyResults.h"

namespace tacto::gui {

OpenStudy::OpenStudy(QObject* parent, Study::Surroundings around) : QObject(parent), around_(std::move(around)) {}

Profile OpenStudy::profile() const { return profile_ ? profile_() : shippedProfile().value_or(Profile()); }

Result<OpenStudy::Look> OpenStudy::look(const QString& folder) const {
    const auto seen = Study::open(folder.toStdString(), nullptr, Study::Access::Read, around_);
    if (!seen) return failure(seen);
    return Look{qtext(seen->settings().title), !seen->isRehearsal()};
}

void OpenStudy::begin(Make make) {
    study_.reset();
    const auto made = std::make_shared<std::optional<Study>>();
    work_.start(
        [made, make = std::move(make)](const WorkPort&) -> Result<void> {
            auto study = make();
            if (!study) return failure(study);
            made->emplace(std::move(*study));
            return {};
        },
        [this, made](const Result<void>& done) {
            if (done) {
                study_ = std::move(*made);
            } else {
                folder_.clear();
                passphrase_.reset();
            }
            emit changed();
            if (done)
                emit opened();
            else
                emit refused(sentence(done.error()));
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
    // Behind it, and in its place: what it opens is forgotten unseen.
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

void OpenStudy::exportBids(const QString& place, const BidsWith& with) {
    if (study() == nullptr) return;
    work_.start([this, with, out = place.toStdString()](
                    const WorkPort&) { return tacto::exportBids(*study_, with, out, TACTOSCOPE_VERSION); },
                [this, place](const Result<void>& done) {
                    emit changed();
                    if (done)
                        emit exported(place);
                    else
                        emit refused(sentence(done.error()));
                });
    emit changed();
}

void OpenStudy::readResult(const QString& id) {
    if (study() == nullptr) return;
    const auto session = study_->session(id.toStdString());
    if (!session) return emit refused(sentence(session.error()));
    const auto read = std::make_shared<RunResult>();
    work_.start(
        [this, read, session = *session](const WorkPort&) -> Result<void> {
            auto found = recordedResult(*study_, session);
            if (!found) return failure(found);
            *read = std::move(*found);
            return {};
        },
        [this, read](const Result<void>& done) {
            emit changed();
            if (done)
                emit resultRead(*read);
            else
                emit refused(sentence(done.error()));
        });
    emit changed();
}

}  // namespace tacto::gui

#include "moc_OpenStudy.cpp"
