# Everything that this project's own targets are compiled with, in one place.
# Floating point: never contracted into fused operations, so that every compiler and instruction set gives the same bits.

function(nanomap_target target)
  target_include_directories(${target} PUBLIC "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>"
                                              "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/nanomap>")
  target_compile_features(${target} PUBLIC cxx_std_20)
  nanomap_warnings(${target})
  target_compile_options(${target} PRIVATE -ffp-contract=off)
  nanomap_sanitizers(${target})
endfunction()

function(nanomap_warnings target)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast -Wnon-virtual-dtor
    -Woverloaded-virtual -Wcast-align -Wdouble-promotion -Wformat=2 -Wimplicit-fallthrough -Wunused
    $<$<CXX_COMPILER_ID:GNU>:-Wduplicated-cond -Wlogical-op
                               -Wno-restrict>  # GCC 12 sees overlaps in std::string that are none (GCC bug 105651)
    $<$<BOOL:${NANOMAP_WARNINGS_AS_ERRORS}>:-Werror>)
endfunction()

function(nanomap_sanitizers target)
  if(NANOMAP_SANITIZERS)
    target_compile_options(${target} PUBLIC -fsanitize=${NANOMAP_SANITIZERS} -fno-omit-frame-pointer
                                            -fno-sanitize-recover=all)
    # GCC's own manual: instrumented code draws false warnings of this kind.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
    target_link_options(${target} PUBLIC -fsanitize=${NANOMAP_SANITIZERS})
  endif()
endfunction()
