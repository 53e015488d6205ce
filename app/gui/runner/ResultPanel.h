// ResultPanel.h - how a run ended: the verdict in a word, then why, then the numbers, then the session and its report.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QWidget>

#include "app/gui/desk/BenchDesk.h"
#include "app/gui/runner/ReportMaker.h"

namespace tacto::gui {

class ResultTables;

class ResultPanel final : public QWidget {
    Q_OBJECT
public:
    explicit ResultPanel(QWidget* parent = nullptr);
    void clear();
    /// Shows the run and has its reports drawn.
    void show(const FinishedRun& run);
    /// "PASS", as it stands there.
    [[nodiscard]] QString word() const { return word_; }

signals:
    void scriptErrorChosen(int line, const QString& why);  ///< the operator wants to see the line
    void reportReady(const QString& pdf);                  ///< written
    void reportWanted(const QString& pdf);                 ///< to be shown

protected:
    void changeEvent(QEvent* event) override;

private:
    [[nodiscard]] QWidget* buildReportRow();
    void colour();
    void showReportState(const QString& said);
    QLabel* verdict_;
    QLabel* why_;
    QLabel* empty_;
    QLabel* files_;
    QLabel* reportState_;
    ResultTables* numbers_;
    QPushButton* openReport_;
    QPushButton* cancelReport_;
    QProgressBar* drawing_;
    QPushButton* toScript_;
    ReportMaker maker_;
    QString report_;       // the PDF, once it is written
    QString reportFault_;  // of the first report that failed
    QString verdictKey_;
    QString word_;
    QString error_;
    int errorLine_ = 0;
};

/// The verdict as a person reads it: word and shape, and its colour. `key` as RunResult::verdict(), or "error".
struct VerdictLook {
    QString shape;
    QString word;
    QColor colour;
};
[[nodiscard]] VerdictLook verdictLook(const QString& key);

}  // namespace tacto::gui
