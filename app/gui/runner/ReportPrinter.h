// ReportPrinter.h - prints a report on one of the computer's printers. The pages are drawn on a separate thread: each
// takes a tenth of a second, and STOP must not wait for that. Qt's print dialog is not used because it opens modal
// dialogs.
#pragma once

#include <QMenu>
#include <QPrinter>
#include <atomic>
#include <memory>

#include "app/gui/controller/SideWork.h"

namespace tacto::gui {

class ReportPrinter final : public QObject {
    Q_OBJECT
public:
    explicit ReportPrinter(QObject* parent = nullptr);
    ~ReportPrinter() override;  ///< drops pages not drawn yet, and waits for the present one
    /// Adds a menu entry for each printer, which prints all pages; or one that says there is no printer.
    void offer(QMenu& menu, const QString& pdf);
    /// Prints the pages chosen in `printer` of the report in `pdf`, after any present print job.
    void print(const QString& pdf, const std::shared_ptr<QPrinter>& printer);

signals:
    /// Tells the progress, the end or the failure of a print job, in a sentence.
    void said(const QString& what);
    /// The print job is over; `pages` is the number of pages sent to the printer.
    void ended(int pages);

private:
    std::shared_ptr<std::atomic<bool>> givenUp_ = std::make_shared<std::atomic<bool>>(false);
    SideWork prints_;
};

}  // namespace tacto::gui
