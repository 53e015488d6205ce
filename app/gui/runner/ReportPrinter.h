// ReportPrinter.h - prints a report on one of the computer's printers. Its pages are drawn on a thread of their own:
// each takes a tenth of a second, and STOP does not wait for it. Qt's print dialog is not used because it opens modal
// ones.
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
    ~ReportPrinter() override;  ///< gives up the pages that are not drawn yet, and waits for the present one
    /// Adds an entry for each printer, which prints all pages there; or a sentence that there is none.
    void offer(QMenu& menu, const QString& pdf);
    /// The pages that `printer` is set to, of the report in `pdf`. After what is being printed.
    void print(const QString& pdf, const std::shared_ptr<QPrinter>& printer);

signals:
    /// How far it is, that it is done, or why not: a sentence.
    void said(const QString& what);
    /// Nothing more comes; `pages` went to the printer.
    void ended(int pages);

private:
    std::shared_ptr<std::atomic<bool>> givenUp_ = std::make_shared<std::atomic<bool>>(false);
    SideWork prints_;
};

}  // namespace tacto::gui
