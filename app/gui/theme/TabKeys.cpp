#include "app/gui/theme/TabKeys.h"

namespace tacto::gui {

void TabKeys::add(const QString& title) {
    auto* key = new QShortcut(QKeySequence::mnemonic(title), &owner_);
    key->setEnabled(false);
    QObject::connect(key, &QShortcut::activated, &owner_, [this, index = int(keys_.size())] { choose_(index); });
    keys_.push_back(key);
}

void TabKeys::setEnabled(bool enabled) {
    for (auto* key : keys_) key->setEnabled(enabled);
}

}  // namespace tacto::gui
