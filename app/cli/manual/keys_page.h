// The manual's page of keys, made from the lists that also handle them, so that it names nothing
// that does not exist (resources/doc/manual/keys.md).
#pragma once

#include <string>

namespace arthro::app {

std::string KeysPage();

}  // namespace arthro::app
