// ReportView.h - a report's pages, with zoom and print; the desktop's viewer is one button away.
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
    /// `empty` is said while there is no report.
    explicit ReportView(const QString& empty, QWidget* parent = nullptr);
    /// A report that is written. It is read when it is looked at: a long one takes a moment.
    void show(const QString& pdf);
    void clear();
    [[nodiscard]] const QString& report() const { return report_; }
    /// The last line of buttons below the pages: what is added stands at its end.
    [[nodiscard]] QHBoxLayout& row() { return *row_; }

signals:
    /// How far the printer is, or why the pages cannot be shown: a sentence.
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
    QHBoxLayout* row_ = nullptr;  ///< a line of its own where the buttons have no room beside it
    QWidget* zoom_ = nullptr;     ///< its buttons
    QPushButton* print_ = nullptr;
    QPushButton* elsewhere_ = nullptr;
    ReportPrinter* printer_;
    QString report_;  ///< empty: none
};

// A report that is written, in a window of the program: zoom, print, and the desktop's viewer.

class ReportWindow final : public QDialog {
    Q_OBJECT
public:
    /// Shows the report below the safety bar of the window of `asking`. One that is open already shows what is written
    /// there now.
    static void showReport(QWidget& asking, const QString& pdf);

private:
    ReportWindow(const QString& pdf, QWidget* parent);
    ReportView* view_;
};

}  // namespace tacto::gui
