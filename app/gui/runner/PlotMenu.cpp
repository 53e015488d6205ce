#include "app/gui/runner/PlotMenu.h"

#include <QApplication>
#include <QClipboard>
#include <QFileDialog>
#include <QMessageBox>

namespace tacto::gui {

namespace {

constexpr double kPictureScale = 2;  // sharp on paper and on a screen of twice the density

void save(QCustomPlot& plot, const QString& name) {
    auto* dialog = new QFileDialog(&plot, QObject::tr("Save the plot"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setNameFilters({QObject::tr("Picture (*.png)"), QObject::tr("PDF (*.pdf)")});
    dialog->setDefaultSuffix("png");
    dialog->selectFile(name + ".png");
    QObject::connect(dialog, &QFileDialog::fileSelected, &plot, [&plot](const QString& path) {
        const bool written = path.endsWith(".pdf") ? plot.savePdf(path) : plot.savePng(path, 0, 0, kPictureScale);
        if (written) return;
        auto* box = new QMessageBox(QMessageBox::Warning, QObject::tr("Not saved"),
                                    QObject::tr("%1 cannot be written. Choose another folder.").arg(path),
                                    QMessageBox::Ok, &plot);
        box->setAttribute(Qt::WA_DeleteOnClose);
        box->open();
    });
    dialog->open();
}

}  // namespace

void addPlotMenu(QCustomPlot& plot, const QString& name) {
    auto* copy = new QAction(QObject::tr("&Copy as picture"), &plot);
    QObject::connect(copy, &QAction::triggered, &plot,
                     [&plot] { QApplication::clipboard()->setPixmap(plot.toPixmap(0, 0, kPictureScale)); });
    auto* store = new QAction(QObject::tr("&Save as…"), &plot);
    QObject::connect(store, &QAction::triggered, &plot, [&plot, name] { save(plot, name); });
    plot.addActions({copy, store});
    plot.setContextMenuPolicy(Qt::ActionsContextMenu);
    plot.setFocusPolicy(Qt::StrongFocus);
}

}  // namespace tacto::gui
