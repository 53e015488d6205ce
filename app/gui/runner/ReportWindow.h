// ReportWindow.h - a report that is written, in a window of the program: zoom, print, and the desktop's viewer.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QDialog>

namespace tacto::gui {

class ReportView;

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
