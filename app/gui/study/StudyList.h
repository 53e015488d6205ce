// StudyList.h - page for an open study: its approval, its participants and sessions with their states in words, and the
// actions on each. Every change has its own dialog.
#pragma once

#include <QLabel>
#include <QPointer>
#include <QPushButton>
#include <QString>
#include <QWidget>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/gui/runner/ReportMaker.h"
#include "app/gui/study/OpenStudy.h"
#include "core/study/Study.h"

namespace tacto::gui {

/// Returns the rows as in RecordColumns.h: {code, who, group, state, consent, sessions}; no withdrawn participants.
[[nodiscard]] nlohmann::json participantRows(const Study& study);
class PageTable;
class StudySessions;

class StudyList final : public QWidget {
    Q_OBJECT
public:
    /// `study` must outlive this.
    explicit StudyList(OpenStudy& study, QWidget* parent = nullptr);
    /// The buttons about the whole study, which the page shows at its foot.
    [[nodiscard]] QWidget* foot() const { return foot_; }
    /// Shows a sentence about a problem; empty for none.
    void say(const QString& what, bool trouble = true);
    /// Returns the chosen participant's code; empty if none is chosen.
    [[nodiscard]] QString chosen() const;

signals:
    void sessionWanted(const QString& code);

private:
    [[nodiscard]] QWidget* buildParticipants();
    [[nodiscard]] QWidget* buildOfOne();
    [[nodiscard]] QWidget* buildFoot();
    /// Adds an action to the button's menu; triggering it clears the previous message.
    QAction* addAction(QPushButton& to, const QString& text, const char* name, std::function<void()> act);
    void refresh();
    void showTables(const Study& study);
    void judge();
    void choose(const QString& code);
    void askForConsent(const QString& code);
    [[nodiscard]] QString signedIn(const QString& code) const;
    void showHold(const Study& study);
    void makeReport(const QString& title, const QString& name, const QStringList& more);
    void askForExport(const BidsWith& with);
    void changePassphrase();
    [[nodiscard]] bool noteReport(const QString& out, const QStringList& more);

    OpenStudy& study_;
    ReportMaker reports_;
    QString code_;  ///< the chosen participant's code
    QWidget* foot_ = nullptr;
    QLabel* title_;
    QLabel* facts_;
    QLabel* keys_;  ///< where the key file lies, and who should hold a copy
    QLabel* hold_;  ///< why no session can begin; hidden if one can
    QLabel* trouble_;
    PageTable* participants_;
    QLabel* withdrawn_;
    StudySessions* sessions_;
    std::vector<QPushButton*> ofOne_;  ///< buttons that need a participant
    std::vector<QPushButton*> all_;    ///< buttons that need the study
    QAction* release_ = nullptr;       ///< shown if a serious event holds the study
    QAction* passphrase_ = nullptr;
    QAction* goBack_ = nullptr;  ///< shown if the ledger is older than the newest known
    QWidget* ofOneRow_ = nullptr;
    QPointer<QWidget> focus_;  ///< what had the focus before the study was busy
};

/// The sessions of a study as a table, with a button that shows the result of a complete session.
class StudySessions final : public QWidget {
    Q_OBJECT
public:
    /// The table is as wide as `page` allows.
    explicit StudySessions(QWidget& page);
    /// Shows the sessions; hides the table if there are none.
    void show(const Study& study);
    /// Set to false while the study cannot be read.
    void setReadable(bool readable);
    using QWidget::show;

signals:
    void resultWanted(const QString& id);

private:
    void judge();
    /// Returns the chosen session; null if none is chosen.
    [[nodiscard]] const StudySession* chosen() const;
    std::vector<StudySession> sessions_;  ///< in the order of the rows
    std::string id_;                      ///< id of the chosen session
    bool readable_ = false;
    PageTable* table_;
    QPushButton* result_ = nullptr;
};

}  // namespace tacto::gui
