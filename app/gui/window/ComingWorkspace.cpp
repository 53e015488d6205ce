#include "app/gui/window/ComingWorkspace.h"

#include <QLabel>
#include <QVBoxLayout>

#include "app/gui/theme/Theme.h"

namespace tacto::gui {

ComingWorkspace::ComingWorkspace(const QString& title, const QString& purpose, const QStringList& willCome,
                                 const QString& meanwhile, QWidget* parent)
    : QWidget(parent) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(40, 40, 40, 40);
    layout->addWidget(heading(title, this));
    auto* why = new QLabel(purpose, this);
    why->setWordWrap(true);
    layout->addWidget(why);
    layout->addSpacing(16);
    layout->addWidget(explanation(tr("This version does not have it yet. What will come:"), this));
    auto* list = new QLabel(this);
    QString items;
    for (const auto& item : willCome) items += "<li>" + item.toHtmlEscaped() + "</li>";
    list->setText("<ul>" + items + "</ul>");
    list->setWordWrap(true);
    layout->addWidget(list);
    layout->addWidget(explanation(meanwhile, this));
    layout->addStretch();
}

}  // namespace tacto::gui
