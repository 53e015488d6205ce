// ReportView.h - shows a report's pages, with zoom, print and save, and buttons for its folder and the desktop's
// viewer.
#pragma once

#include <QDialog>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QPdfDocument>
#include <QPdfView>
#include <QPushButton>
#include <QWidget>
#include <array>

namespace tacto::gui {

class ReportPrinter;

class ReportView final : public QWidget {
    Q_OBJECT
public:
    /// `empty` is the text shown while there is no report.
    explicit ReportView(const QString& empty, QWidget* parent = nullptr);
    /// Shows a written report. A long one takes a moment, so it is read only once this view is visible.
    void show(const QString& pdf);
    void clear();
    [[nodiscard]] const QString& report() const { return report_; }
    /// Fills a menu with the buttons that need a report; leaves it empty if there is none.
    void offerActs(QMenu& menu) const;
    /// Returns the last row of buttons below the pages; further buttons are added at its end.
    [[nodiscard]] QHBoxLayout& row() { return *row_; }

signals:
    /// Tells in a sentence what was done with the report or why not, or why the pages cannot be shown.
    void said(const QString& what);
    void unreadable(const QString& why);

private:
    [[nodiscard]] QWidget* buildRow();
    [[nodiscard]] QWidget* buildZoom(QWidget* parent);
    void read();
    void offer();
    void zoom(double factor);
    void askSave();

    QLabel* empty_;
    QPdfDocument* document_;
    QPdfView* view_;
    QHBoxLayout* row_ = nullptr;  ///< a second line if the buttons need one
    QWidget* zoom_ = nullptr;     ///< holds the zoom buttons
    QPushButton* print_ = nullptr;
    std::array<QPushButton*, 4> acts_{};  ///< print_ and the others that need a report
    ReportPrinter* printer_;
    QString report_;  ///< empty if there is none
};

// A written report in a window of its own.

class ReportWindow final : public QDialog {
    Q_OBJECT
public:
    /// Shows the report below the safety bar of the window that contains `asking`. If a window for this report is
    /// already open, it is reloaded.
    /// `session`: that of the report, in which a signature can be noted; empty for a report of something else.
    static void showReport(QWidget& asking, const QString& pdf, const QString& session = {});

private:
    ReportWindow(const QString& pdf, const QString& session, QWidget* parent);
    ReportView* view_;
};

}  // namespace tacto::gui
