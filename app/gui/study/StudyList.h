// StudyList.h - an open study on one page: its approval, its participants and sessions with their states in words, and
// what can be done with each. Every change has a dialog of its own.
#pragma once

#include <QLabel>
#include <QPushButton>
#include <QString>
#include <QWidget>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/gui/runner/ReportMaker.h"
#include "app/gui/study/OpenStudy.h"
#include "core/study/Study.h"

namespace tacto::gui {

/// The rows as RecordColumns.h shows them: {code, who, group, state, consent, sessions}; without those who withdrew.
[[nodiscard]] nlohmann::json participantRows(const Study& study);
class PageTable;
class StudySessions;

class StudyList final : public QWidget {
    Q_OBJECT
public:
    /// `study` outlives it.
    explicit StudyList(OpenStudy& study, QWidget* parent = nullptr);
    /// A sentence in the way; empty for none.
    void say(const QString& what, bool trouble = true);
    /// Says why no session can begin; says nothing where one can.
    void sayWhatHinders();
    /// Empty where none is.
    [[nodiscard]] QString chosen() const;

signals:
    void sessionWanted(const QString& code);

private:
    [[nodiscard]] QWidget* buildParticipants();
    [[nodiscard]] QWidget* buildOfOne();
    [[nodiscard]] QWidget* buildFoot();
    /// Into its menu; what was said before is taken back.
    QAction* addAction(QPushButton& to, const QString& text, const char* name, std::function<void()> act);
    void refresh();
    void showTables(const Study& study);
    void judge();
    void choose(const QString& code);
    void askForConsent(const QString& code);
    void makeReport(const QString& title, const QString& name, const QStringList& more);
    void askForExport(const BidsWith& with);
    [[nodiscard]] bool noteReport(const QString& out, const QStringList& more);

    OpenStudy& study_;
    ReportMaker reports_;
    QString code_;  ///< the chosen participant's code
    QLabel* title_;
    QLabel* facts_;
    QLabel* trouble_;
    PageTable* participants_;
    QLabel* withdrawn_;
    StudySessions* sessions_;
    std::vector<QPushButton*> ofOne_;  ///< need a participant
    std::vector<QPushButton*> all_;    ///< need the study
    QAction* goBack_ = nullptr;        ///< shown where the ledger is not the newest known
    QWidget* ofOneRow_ = nullptr;
};

/// The sessions of a study as a table, and the way to the result of one that is complete.
class StudySessions final : public QWidget {
    Q_OBJECT
public:
    /// The table is as wide as `page` has room for.
    explicit StudySessions(QWidget& page);
    /// Hidden where there are none.
    void show(const Study& study);
    /// False while the study is not there to be read.
    void setReadable(bool readable);
    using QWidget::show;

signals:
    void resultWanted(const QString& id);

private:
    void judge();
    /// Null where none is chosen.
    [[nodiscard]] const StudySession* chosen() const;
    std::vector<StudySession> sessions_;  ///< the sessions in the order of the rows
    std::string id_;                      ///< the chosen one's id
    bool readable_ = false;
    PageTable* table_;
    QPushButton* result_ = nullptr;
};

}  // namespace tacto::gui
