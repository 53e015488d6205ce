// OpenStudy.h - the study that the window has open: opened and made beside the window, since a passphrase takes a
// second, changed at once, and lent to a session while that runs.
//
// While it is open no other program changes it. The passphrase lies in locked memory, and in no setting.
#pragma once

#include <QObject>
#include <QString>
#include <functional>
#include <memory>
#include <optional>

#include "app/gui/sessions/Background.h"
#include "app/run/ProtocolRun.h"
#include "core/bench/Profile.h"
#include "core/sharing/BidsFiles.h"
#include "core/study/Study.h"

namespace tacto::gui {

class OpenStudy final : public QObject {
    Q_OBJECT
public:
    explicit OpenStudy(QObject* parent = nullptr, Study::Surroundings around = {});

    /// Null where none is open, or while it is lent, opened or exported.
    [[nodiscard]] Study* study() noexcept { return busy() || !study_ ? nullptr : &*study_; }
    [[nodiscard]] bool busy() const { return work_.busy(); }
    [[nodiscard]] QString folder() const { return folder_; }
    [[nodiscard]] const std::shared_ptr<const Secret>& passphrase() const noexcept { return passphrase_; }

    /// The study's title, and whether it needs a passphrase. Errors: as Study::open().
    struct Look {
        QString title;
        bool sealed = true;
    };
    [[nodiscard]] Result<Look> look(const QString& folder) const;
    /// `passphrase` null: a rehearsal. opened() or refused() follows.
    void open(const QString& folder, std::shared_ptr<const Secret> passphrase);
    void create(const QString& folder, const StudySettings& settings, std::shared_ptr<const Secret> passphrase);
    /// Gives up an opening that is under way: neither opened() nor refused() follows.
    void giveUpOpening();
    void close();
    /// Lends it to a session, which opens it by itself; takeBack() opens it again.
    void lend();
    void takeBack();
    /// exported() or refused() follows.
    void exportBids(const QString& place, const BidsWith& with = {});
    /// Reads the result of session `id`, beside the window. resultRead() or refused() follows.
    void readResult(const QString& id);
    /// The profile that its sessions are run with: an approval is for it. The shipped one until it is set.
    void setProfile(std::function<Profile()> profile) { profile_ = std::move(profile); }
    [[nodiscard]] Profile profile() const;
    /// Call after a change through study(): emits the change.
    void noteChange() { emit changed(); }

signals:
    void changed();  ///< study() or its content has changed
    void opened();
    void refused(const QString& why);
    void exported(const QString& place);
    void resultRead(const tacto::RunResult& result);

private:
    using Make = std::function<Result<Study>()>;
    void begin(Make make);

    const Study::Surroundings around_;
    std::function<Profile()> profile_;
    QString folder_;
    std::shared_ptr<const Secret> passphrase_;
    std::optional<Study> study_;
    Background work_;  // stands last, so that it ends before what it works on
};

}  // namespace tacto::gui
