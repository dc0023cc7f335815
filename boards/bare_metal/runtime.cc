// What the compiler and the C++ library call where a program has no operating system: all of it means that something is
// wrong, for the firmware takes no heap and throws nothing. None of it is in the program unless something calls it.
#include <cstddef>
#include <cstdint>
#include <new>

#include "boards/bare_metal/semihosting.h"
#include "boards/bare_metal/trap.h"

namespace usuzumi::boards {

void trap(const char* what, std::uintptr_t caller) {
  constexpr char kDigits[] = "0123456789abcdef";
  char address[8];
  for (int i = 0; i < 8; ++i) address[i] = kDigits[caller >> (28 - 4 * i) & 15u];
  semihosting::print("trap: ");
  semihosting::print(what);
  semihosting::print(", called from 0x");
  semihosting::print({address, sizeof address});
  semihosting::print("\n");
  semihosting::exit(kExitTrap);
}

void trap(const char* what, const void* caller) { trap(what, reinterpret_cast<std::uintptr_t>(caller)); }

}  // namespace usuzumi::boards

using usuzumi::boards::trap;

#define USUZUMI_CALLER __builtin_return_address(0)

void* operator new(std::size_t) { trap("operator new: there is no heap", USUZUMI_CALLER); }
void* operator new[](std::size_t) { trap("operator new[]: there is no heap", USUZUMI_CALLER); }
void* operator new(std::size_t, std::align_val_t) { trap("operator new: there is no heap", USUZUMI_CALLER); }
void* operator new[](std::size_t, std::align_val_t) { trap("operator new[]: there is no heap", USUZUMI_CALLER); }
void* operator new(std::size_t, const std::nothrow_t&) noexcept {
  trap("operator new: there is no heap", USUZUMI_CALLER);
}
void* operator new[](std::size_t, const std::nothrow_t&) noexcept {
  trap("operator new[]: there is no heap", USUZUMI_CALLER);
}
// A class with a virtual destructor names these in its table; only a heap would call them.
void operator delete(void*) noexcept { trap("operator delete: there is no heap", USUZUMI_CALLER); }
void operator delete[](void*) noexcept { trap("operator delete[]: there is no heap", USUZUMI_CALLER); }
void operator delete(void*, std::size_t) noexcept { trap("operator delete: there is no heap", USUZUMI_CALLER); }
void operator delete[](void*, std::size_t) noexcept { trap("operator delete[]: there is no heap", USUZUMI_CALLER); }
void operator delete(void*, std::align_val_t) noexcept { trap("operator delete: there is no heap", USUZUMI_CALLER); }
void operator delete[](void*, std::align_val_t) noexcept {
  trap("operator delete[]: there is no heap", USUZUMI_CALLER);
}
void operator delete(void*, std::size_t, std::align_val_t) noexcept {
  trap("operator delete: there is no heap", USUZUMI_CALLER);
}
void operator delete[](void*, std::size_t, std::align_val_t) noexcept {
  trap("operator delete[]: there is no heap", USUZUMI_CALLER);
}

// The library's checks of what would be thrown elsewhere; declared here as libstdc++ has them, for its own definitions
// bring the whole of its exceptions and their heap into the program.
namespace std {
[[noreturn]] void __throw_bad_alloc();
[[noreturn]] void __throw_bad_array_new_length();
[[noreturn]] void __throw_bad_function_call();
[[noreturn]] void __throw_bad_optional_access();
[[noreturn]] void __throw_invalid_argument(const char* what);
[[noreturn]] void __throw_length_error(const char* what);
[[noreturn]] void __throw_logic_error(const char* what);
[[noreturn]] void __throw_out_of_range(const char* what);
[[noreturn]] void __throw_out_of_range_fmt(const char* what, ...);

void __throw_bad_alloc() { trap("std::bad_alloc", USUZUMI_CALLER); }
void __throw_bad_array_new_length() { trap("std::bad_array_new_length", USUZUMI_CALLER); }
void __throw_bad_function_call() { trap("std::bad_function_call", USUZUMI_CALLER); }
void __throw_bad_optional_access() { trap("std::bad_optional_access", USUZUMI_CALLER); }
void __throw_invalid_argument(const char* what) { trap(what, USUZUMI_CALLER); }
void __throw_length_error(const char* what) { trap(what, USUZUMI_CALLER); }
void __throw_logic_error(const char* what) { trap(what, USUZUMI_CALLER); }
void __throw_out_of_range(const char* what) { trap(what, USUZUMI_CALLER); }
void __throw_out_of_range_fmt(const char* what, ...) { trap(what, USUZUMI_CALLER); }
}  // namespace std

extern "C" {

// Where static objects are registered for their destruction at exit, which never comes. An object that has a
// destructor is built all the same.
void* __dso_handle = nullptr;
int __cxa_atexit(void (*)(void*), void*, void*);
int __cxa_atexit(void (*)(void*), void*, void*) { return 0; }
int __aeabi_atexit(void*, void (*)(void*), void*);
int __aeabi_atexit(void*, void (*)(void*), void*) { return 0; }

[[noreturn]] void __cxa_pure_virtual();
void __cxa_pure_virtual() { trap("pure virtual function", USUZUMI_CALLER); }

[[noreturn]] void abort();
void abort() { trap("abort", USUZUMI_CALLER); }

/// newlib's assert() ends here.
[[noreturn]] void __assert_func(const char* file, int line, const char* function, const char* expression);
void __assert_func(const char* file, int, const char*, const char* expression) {
  usuzumi::boards::semihosting::print(file);
  usuzumi::boards::semihosting::print(": ");
  trap(expression, USUZUMI_CALLER);
}

}  // extern "C"
