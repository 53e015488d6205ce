#include "app/gui/runner/ReportWindow.h"

#include <QFileInfo>
#include <QVBoxLayout>

#include "app/gui/runner/ReportView.h"
#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/Labels.h"

namespace tacto::gui {

namespace {
constexpr int kWideChars = 110, kHighLines = 42;
}

ReportWindow::ReportWindow(const QString& pdf, QWidget* parent)
    : QDialog(parent), view_(new ReportView(tr("The report is not read yet."), this)) {
    setObjectName("reportWindow");
    setWindowTitle(tr("Report %1").arg(QFileInfo(pdf).fileName()));
    auto* column = new QVBoxLayout(this);
    column->addWidget(view_, 1);
    auto* says = new ElidedLabel(pdf, this);
    says->setToolTip(pdf);
    auto* close = new QPushButton(tr("Close"), this);
    close->setAutoDefault(false);
    connect(close, &QPushButton::clicked, this, &QDialog::close);
    view_->row().addWidget(says, 1);
    view_->row().addWidget(close);
    const auto say = [says](const QString& what) {
        says->setText(what);
        says->setToolTip(what);
    };
    connect(view_, &ReportView::said, says, say);
    connect(view_, &ReportView::unreadable, says, say);
    view_->show(pdf);
    resize(fontMetrics().averageCharWidth() * kWideChars, fontMetrics().height() * kHighLines);
}

void ReportWindow::showReport(QWidget& asking, const QString& pdf) {
    for (auto* other : asking.findChildren<ReportWindow*>()) {
        if (!other->isVisible() || other->view_->report() != pdf) continue;
        other->view_->show(pdf);
        other->raise();
        return other->activateWindow();
    }
    openDialog(new ReportWindow(pdf, &asking));
}

}  // namespace tacto::gui

#include "moc_ReportWindow.cpp"
