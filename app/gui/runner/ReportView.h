// ReportView.h - shows a report's pages, with zoom and print, and a button for the desktop's viewer.
#pragma once

#include <QDialog>
#include <QHBoxLayout>
#include <QLabel>
#include <QPdfDocument>
#include <QPdfView>
#include <QPushButton>
#include <QWidget>

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
    /// Returns the last row of buttons below the pages; further buttons are added at its end.
    [[nodiscard]] QHBoxLayout& row() { return *row_; }

signals:
    /// Tells in a sentence how far printing is, or why the pages cannot be shown.
    void said(const QString& what);
    void unreadable(const QString& why);

private:
    [[nodiscard]] QWidget* buildRow();
    [[nodiscard]] QWidget* buildZoom(QWidget* parent);
    void read();
    void offer();
    void zoom(double factor);

    QLabel* empty_;
    QPdfDocument* document_;
    QPdfView* view_;
    QHBoxLayout* row_ = nullptr;  ///< a second line if the buttons need one
    QWidget* zoom_ = nullptr;     ///< holds the zoom buttons
    QPushButton* print_ = nullptr;
    QPushButton* elsewhere_ = nullptr;
    ReportPrinter* printer_;
    QString report_;  ///< empty if there is none
};

// A written report in a window of its own: zoom, print, and the desktop's viewer.

class ReportWindow final : public QDialog {
    Q_OBJECT
public:
    /// Shows the report below the safety bar of the window that contains `asking`. If a window for this report is
    /// already open, it is reloaded.
    static void showReport(QWidget& asking, const QString& pdf);

private:
    ReportWindow(const QString& pdf, QWidget* parent);
    ReportView* view_;
};

}  // namespace tacto::gui
