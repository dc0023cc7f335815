# Toolchain: Debian's gcc-arm-none-eabi, for a Cortex-M7 with double-precision floating point.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)  # CMake's own test program has no linker script

# Sections for the linker to drop; no word on an ABI change of GCC 7, for all is built by one compiler; file names
# relative, so that the program is the same bytes wherever it is built. Nobody looks at errno after a square root, and
# newlib's would bring a kilobyte of variables.
cmake_path(GET CMAKE_CURRENT_LIST_DIR PARENT_PATH boards_folder)
cmake_path(GET boards_folder PARENT_PATH source_folder)
string(JOIN " " CMAKE_CXX_FLAGS_INIT
  -mcpu=cortex-m7 -mthumb -mfloat-abi=hard -mfpu=fpv5-d16
  -fno-exceptions -fno-rtti -fno-threadsafe-statics -ffunction-sections -fdata-sections -Wno-psabi -fno-math-errno
  -ffile-prefix-map=${source_folder}/=)
