// ResultPanel.h - how a run ended: the verdict in a word, then why, then the numbers, then the report.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QLabel>
#include <QPushButton>
#include <QTreeWidget>
#include <QWidget>

#include "app/gui/desk/BenchDesk.h"
#include "app/gui/runner/ReportMaker.h"

namespace tacto::gui {

class ResultPanel final : public QWidget {
    Q_OBJECT
public:
    explicit ResultPanel(QWidget* parent = nullptr);
    void clear();
    /// Shows the run and has its reports drawn.
    void show(const FinishedRun& run);
    [[nodiscard]] QString verdict() const { return verdict_->text(); }
    /// The PDF, once it is written.
    [[nodiscard]] QString report() const { return report_; }

signals:
    void scriptErrorChosen(int line);  ///< the operator wants to see the line
    void reportReady(const QString& pdf);

private:
    void showNumbers(const nlohmann::json& results);
    QLabel* verdict_;
    QLabel* why_;
    QLabel* files_;
    QLabel* reportState_;
    QTreeWidget* numbers_;
    QPushButton* openReport_;
    QPushButton* cancelReport_;
    QPushButton* toScript_;
    ReportMaker maker_;
    QString report_;
    int errorLine_ = 0;
};

/// The verdict as a person reads it: word and shape, and its colour.
struct VerdictLook {
    QString text;
    QColor colour;
};
[[nodiscard]] VerdictLook verdictLook(const QString& verdict);

}  // namespace tacto::gui
