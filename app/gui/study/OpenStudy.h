// OpenStudy.h - the study open in the window. Opening and creating run on another thread, since a passphrase takes a
// second to check; changes are made at once; a running session borrows the study.
//
// While it is open, no other program can change it. The passphrase is only in locked memory, never in a setting.
#pragma once

#include <QObject>
#include <QString>
#include <functional>
#include <memory>
#include <optional>

#include "app/gui/sessions/Background.h"
#include "app/report/PilotFigures.h"
#include "app/run/ProtocolRun.h"
#include "core/bench/Profile.h"
#include "core/sharing/BidsFiles.h"
#include "core/study/Study.h"

namespace tacto::gui {

/// The results of a study as a page shows them.
struct StudyShown {
    std::vector<nlohmann::json> parts;  ///< of each kind of participants, as toJson(StudyFigures), with "basis"
    std::vector<PilotFigure> figures;
};

class OpenStudy final : public QObject {
    Q_OBJECT
public:
    explicit OpenStudy(QObject* parent = nullptr, Study::Surroundings around = {});

    /// Null if no study is open, or while the study is lent, being opened or exported.
    [[nodiscard]] Study* study() noexcept { return busy() || !study_ ? nullptr : &*study_; }
    [[nodiscard]] bool busy() const { return work_.busy(); }
    [[nodiscard]] QString folder() const { return folder_; }
    [[nodiscard]] const std::shared_ptr<const Secret>& passphrase() const noexcept { return passphrase_; }

    /// The study's title, and whether it needs a passphrase. look() errors: as Study::open().
    struct Look {
        QString title;
        bool sealed = true;
    };
    [[nodiscard]] Result<Look> look(const QString& folder) const;
    /// Opens a study; `passphrase` is null for a rehearsal. opened() or refused() follows.
    void open(const QString& folder, std::shared_ptr<const Secret> passphrase);
    void create(const QString& folder, const StudySettings& settings, std::shared_ptr<const Secret> passphrase);
    /// Cancels an opening under way: neither opened() nor refused() follows.
    void giveUpOpening();
    void close();
    /// Lends the study to a session, which opens the folder itself; takeBack() opens the study here again.
    void lend();
    void takeBack();
    /// Seals the study's keys under another passphrase; passphraseChanged() or refused() follows.
    void changePassphrase(std::shared_ptr<const Secret> next);
    /// Exports the study; exported() or refused() follows.
    void exportBids(const QString& place, const BidsWith& with = {});
    /// Reads the result of session `id` on another thread. resultRead() or refused() follows.
    void readResult(const QString& id);
    /// Reads the results of all sessions on another thread. resultsRead() or refused() follows.
    void readResults();
    /// Sets the profile for the study's sessions, to which the approval refers. Until then the shipped profile is used.
    void setProfile(std::function<Profile()> profile) { profile_ = std::move(profile); }
    [[nodiscard]] Profile profile() const;
    /// Call this after a change through study(); emits changed().
    void noteChange() { emit changed(); }

signals:
    void changed();  ///< study() or its content has changed
    void opened();
    void refused(const QString& why);
    void passphraseChanged();
    void exported(const QString& place);
    void resultRead(const tacto::RunResult& result);
    void resultsRead(const tacto::gui::StudyShown& shown);

private:
    using Make = std::function<Result<Study>()>;
    void begin(Make make);

    const Study::Surroundings around_;
    std::function<Profile()> profile_;
    QString folder_;
    std::shared_ptr<const Secret> passphrase_;
    std::optional<Study> study_;
    Background work_;  // declared last, so that it ends before the data it uses
};

}  // namespace tacto::gui
