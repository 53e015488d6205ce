// SignPage.h - the report, to be signed: what signing is, who and what this report names, and its pages.
//
// A signature is by hand, on paper or in the PDF; the program keeps names and draws the lines. It counts as done once
// the report was printed or opened from here.
#pragma once

#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QWidget>
#include <vector>

#include "app/gui/controller/BenchController.h"
#include "app/gui/runner/ReportMaker.h"

namespace tacto::gui {

class ReportView;

class SignPage final : public QWidget {
    Q_OBJECT
public:
    explicit SignPage(QWidget* parent = nullptr);
    /// Clears the page before a run: there is no report, and none is being drawn any longer.
    void clear();
    /// Has the reports of the run drawn.
    void show(const FinishedRun& run);
    /// Whether it is signed, as far as the program sees it; before that, how far the report is. For the step.
    [[nodiscard]] QString note() const;
    /// The report of this run was printed or opened from here.
    [[nodiscard]] bool taken() const noexcept { return taken_; }
    /// A report that is written already.
    void showReport(const QString& pdf);

signals:
    void stateChanged();
    void settingsWanted();  ///< the names are entered there, before the run

private:
    [[nodiscard]] QWidget* buildWords();
    void fitWords(bool beside);
    /// "Written…", "Drawing…", or why there is no report.
    [[nodiscard]] QString state() const;
    void addStateTo(QHBoxLayout& row);
    void showNotes(const RunNotes* notes);
    void take();
    void showState();
    std::vector<QLabel*> notes_;  ///< operator, sample, reviewer, ambient
    QWidget* words_ = nullptr;
    QWidget* named_ = nullptr;
    ReportView* view_;
    bool beside_ = true;  ///< words and report
    QPushButton* cancel_ = nullptr;
    QProgressBar* drawing_ = nullptr;
    QLabel* says_ = nullptr;
    ReportMaker maker_;
    bool taken_ = false;
    QString fault_;    // why the first failed report failed
    QString printed_;  // how far the printer is; empty: nothing was printed
};

}  // namespace tacto::gui
