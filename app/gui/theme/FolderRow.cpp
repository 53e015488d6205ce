#include "app/gui/theme/FolderRow.h"

#include <QHBoxLayout>
#include <QPushButton>

#include "app/gui/theme/Dialogs.h"

namespace tacto::gui {

FolderRow::FolderRow(const QString& path, const QString& tip, const QString& question, QWidget* parent)
    : QWidget(parent), line_(new PathField(path, tip, this)) {
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(8);
    auto* choose = new QPushButton(tr("Ch&oose…"), this);
    choose->setAutoDefault(false);
    choose->setToolTip(tr("Chooses the folder from a list."));
    connect(choose, &QPushButton::clicked, this, [this, question] {
        FileQuestion asked;
        asked.title = question;
        asked.wants = FileQuestion::Wants::NewFolder;
        askForFile(*this, asked, [this](const QString& chosen) { line_->setText(chosen); });
    });
    row->addWidget(line_, 1);
    row->addWidget(choose);
}

}  // namespace tacto::gui

#include "moc_FolderRow.cpp"
