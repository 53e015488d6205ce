// SignPage.h - page for signing the report: what a signature means, who and what the report names, and its pages.
//
// A signature is made by hand, on paper or in the PDF; the program draws the lines. Who signed is then entered here,
// and name, time and the report's hash are kept in the session: only then is the step done.
#pragma once

#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QProgressBar>
#include <QPushButton>
#include <QWidget>
#include <vector>

#include "app/gui/controller/BenchController.h"
#include "app/gui/runner/ReportMaker.h"

namespace tacto::gui {

class ReportView;
class SigningRow;

class SignPage final : public QWidget {
    Q_OBJECT
public:
    explicit SignPage(QWidget* parent = nullptr);
    /// Clears the page before a run and ends the drawing of any report.
    void clear();
    /// Starts drawing the reports of the run.
    void show(const FinishedRun& run);
    /// Returns a note for the step: signed, as far as the program can tell, or how far the report is.
    [[nodiscard]] QString note() const;
    /// True if the session of this run keeps a signature.
    [[nodiscard]] bool isSigned() const;
    [[nodiscard]] bool drawing() const { return maker_.busy(); }
    /// Returns the written report; empty if there is none yet.
    [[nodiscard]] const QString& report() const;
    /// Fills a menu with what can be done with the report, or with the reason why there is none.
    void offerActs(QMenu& menu) const;
    /// Shows a report that has already been written.
    void showReport(const QString& pdf);

signals:
    void stateChanged();
    void settingsWanted();  ///< the names are entered in the settings, before the run

private:
    [[nodiscard]] QWidget* buildWords();
    void fitWords(bool beside);
    /// Returns "Written…", "Drawing…", or why there is no report.
    [[nodiscard]] QString state() const;
    void addStateTo(QHBoxLayout& row);
    void showNotes(const RunNotes* notes);
    void showState();
    std::vector<QLabel*> notes_;  ///< operator, sample, reviewer, ambient
    QWidget* words_ = nullptr;
    QWidget* named_ = nullptr;
    ReportView* view_;
    bool beside_ = true;  ///< words and report are side by side
    QPushButton* cancel_ = nullptr;
    QProgressBar* drawing_ = nullptr;
    QLabel* says_ = nullptr;
    ReportMaker maker_;
    SigningRow* signing_ = nullptr;
    QString session_, by_;  // the session of this run, and its operator
    QString fault_;         // why the first failed report failed
    QString said_;          // what was done with the report last
};

}  // namespace tacto::gui
