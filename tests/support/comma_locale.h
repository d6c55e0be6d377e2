// While it lives, the global locale has a decimal comma and points between thousands.
#pragma once

#include <clocale>
#include <locale>
#include <string>

namespace anvil {

/// German where the machine has it; else a locale made here, which C's functions do not see.
class CommaLocale {
  public:
    CommaLocale() : before_(std::setlocale(LC_ALL, nullptr)) {
        const std::locale commas(std::locale::classic(), new Commas);
        std::locale::global(commas);
        std::setlocale(LC_ALL, "de_DE.UTF-8");
    }
    ~CommaLocale() {
        std::locale::global(global_);
        std::setlocale(LC_ALL, before_.c_str());
    }
    CommaLocale(const CommaLocale&) = delete;
    CommaLocale& operator=(const CommaLocale&) = delete;

  private:
    struct Commas : std::numpunct<char> {
        char do_decimal_point() const override { return ','; }
        char do_thousands_sep() const override { return '.'; }
        std::string do_grouping() const override { return "\3"; }
    };

    std::locale global_;
    std::string before_;
};

} // namespace anvil
