// TabKeys.h - the Alt keys of tabs whose row is hidden: with the plot alone they change the page all the same.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QShortcut>
#include <QString>
#include <functional>
#include <vector>

namespace tacto::gui {

class TabKeys {
public:
    /// Both outlive it. `choose` shows the page of an index.
    TabKeys(QWidget& owner, std::function<void(int)> choose) : owner_(owner), choose_(std::move(choose)) {}
    /// The next page's title, with its mnemonic.
    void add(const QString& title);
    /// The row of tabs is hidden: until then the tab bar has the keys.
    void setEnabled(bool enabled);

private:
    QWidget& owner_;
    const std::function<void(int)> choose_;
    std::vector<QShortcut*> keys_;
};

}  // namespace tacto::gui
