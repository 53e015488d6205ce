#include "app/gui/runner/ReportPrinter.h"

#include <QFileInfo>
#include <QPainter>
#include <QPdfDocument>
#include <QPrinterInfo>
#include <algorithm>

namespace tacto::gui {

namespace {

constexpr int kDots_perInch = 300;  // resolution of the page pictures for the printer
constexpr double kPoints_perInch = 72;

struct Range {
    int first = 0, last = 0;  // counted from 0
};

Range rangeOf(const QPrinter& printer, int pages) {
    if (printer.printRange() != QPrinter::PageRange || printer.fromPage() < 1) return {0, pages - 1};
    return {std::min(printer.fromPage(), pages) - 1, std::clamp(printer.toPage(), printer.fromPage(), pages) - 1};
}

/// Returns the page's rectangle: as large as the paper allows without changing its shape.
QRectF onPaper(const QSizeF& page, const QRectF& paper) {
    const auto size = page.scaled(paper.size(), Qt::KeepAspectRatio);
    return {QPointF((paper.width() - size.width()) / 2, (paper.height() - size.height()) / 2), size};
}

}  // namespace

ReportPrinter::ReportPrinter(QObject* parent) : QObject(parent) {}

ReportPrinter::~ReportPrinter() { givenUp_->store(true); }

void ReportPrinter::offer(QMenu& menu, const QString& pdf) {
    menu.clear();
    for (const auto& name : QPrinterInfo::availablePrinterNames()) {
        menu.addAction(name, this, [this, name, pdf] {
            auto printer = std::make_shared<QPrinter>(QPrinterInfo::printerInfo(name), QPrinter::HighResolution);
            printer->setPageSize(QPageSize(QPageSize::A4));
            printer->setDocName(QFileInfo(pdf).completeBaseName());
            print(pdf, printer);
        });
    }
    if (menu.isEmpty()) menu.addAction(tr("No printer is set up on this computer."))->setEnabled(false);
}

void ReportPrinter::print(const QString& pdf, const std::shared_ptr<QPrinter>& printer) {
    const auto tell = [this](const QString& what) {
        QMetaObject::invokeMethod(
            this, [this, what] { emit said(what); }, Qt::QueuedConnection);
    };
    const auto draw = [pdf, printer, tell, givenUp = givenUp_] {
        QPdfDocument document;  // used by this thread only
        document.load(pdf);
        if (document.pageCount() == 0) {
            tell(tr("%1 cannot be read, so nothing was printed.").arg(pdf));
            return 0;
        }
        printer->setResolution(kDots_perInch);
        printer->setFullPage(true);  // the report has its own margins
        QPainter painter;
        if (!painter.begin(printer.get())) {
            tell(tr("%1 takes no pages, so nothing was printed. Choose another printer.")
                     .arg(printer->outputFileName().isEmpty() ? printer->printerName() : printer->outputFileName()));
            return 0;
        }
        const auto [first, last] = rangeOf(*printer, document.pageCount());
        for (int page = first; page <= last; ++page) {
            if (givenUp->load()) {
                printer->abort();
                return page - first;
            }
            tell(tr("Printing page %1 of %2…").arg(page - first + 1).arg(last - first + 1));
            if (page > first) printer->newPage();
            const auto points = document.pagePointSize(page);
            const auto picture = document.render(page, (points * kDots_perInch / kPoints_perInch).toSize());
            const auto paper = printer->paperRect(QPrinter::DevicePixel);
            painter.drawImage(onPaper(points, QRectF(QPointF(), paper.size())), picture);
        }
        painter.end();
        const int pages = last - first + 1;
        tell(pages == 1 ? tr("One page went to the printer.") : tr("%1 pages went to the printer.").arg(pages));
        return pages;
    };
    prints_.start(this, draw, [this](int pages) { emit ended(pages); });
}

}  // namespace tacto::gui

#include "moc_ReportPrinter.cpp"
