#include "app/gui/theme/PictureTools.h"

#include "app/gui/theme/ToolRow.h"

namespace tacto::gui {

PictureTools::PictureTools(QWidget* parent)
    : QObject(parent),
      save_(makeTool(tr("Save picture"), tr("Saves what is shown as a picture: PNG, SVG or PDF."), "save", parent)),
      copy_(makeTool(tr("Copy picture"), tr("Copies what is shown to the clipboard, as a picture."), "copy", parent)),
      plotOnly_(makeTool(tr("Plot only"), tr("F11: the safety bar and the plot alone; F11 again brings the rest back."),
                         "plot-only", parent)) {
    connect(plotOnly_, &QToolButton::clicked, this, &PictureTools::plotOnlyWanted);
}

void PictureTools::addTo(QLayout& row) {
    for (auto* button : buttons()) row.addWidget(button);
}

void PictureTools::takeFrom(const std::function<Still()>& shown, const QString& name) {
    connect(save_, &QToolButton::clicked, this,
            [this, shown, name] { askSavePicture(*save_->parentWidget(), shown(), name); });
    connect(copy_, &QToolButton::clicked, this, [shown] { copyPicture(shown()); });
}

}  // namespace tacto::gui

#include "moc_PictureTools.cpp"
