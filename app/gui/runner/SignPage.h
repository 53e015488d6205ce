// SignPage.h - the report and who signs it: names for its first page before the run, the report itself after it.
//
// A signature is by hand, on paper or in the PDF; the program keeps names and draws the lines.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QWidget>

#include "app/gui/controller/BenchController.h"
#include "app/gui/runner/ReportMaker.h"

namespace tacto::gui {

class NotesPanel;
class ReportView;

class SignPage final : public QWidget {
    Q_OBJECT
public:
    /// `day` outlives the page.
    explicit SignPage(DayNotes& day, QWidget* parent = nullptr);
    [[nodiscard]] NotesPanel& notes() { return *notes_; }
    /// Before a run: no report, and what is being drawn is given up.
    void clear();
    /// Has the reports of the run drawn.
    void show(const FinishedRun& run);
    /// "written", "being drawn…", or why there is none; for the step.
    [[nodiscard]] QString state() const;
    /// A report that is written already.
    void showReport(const QString& pdf);

signals:
    void stateChanged();

private:
    void addStateTo(QHBoxLayout& row);
    void showState();
    NotesPanel* notes_;
    ReportView* view_;
    QPushButton* cancel_ = nullptr;
    QProgressBar* drawing_ = nullptr;
    QLabel* says_ = nullptr;
    ReportMaker maker_;
    QString fault_;    // of the first report that failed
    QString printed_;  // how far the printer is; empty: nothing was printed
};

}  // namespace tacto::gui
