# Draws fig5-update.svg and fig5-update.png: gnuplot fig5-update.gp
set encoding utf8
do for [kind in 'svg png'] {
if (kind eq 'svg') {
set terminal svg size 900,520 font 'sans,14' background 'white'
} else {
set terminal pngcairo size 1350,780 font 'sans,18'
}
set output 'fig5-update.'.kind
set datafile separator ','
set datafile missing NaN
set title 'Fig. 5: update with 10 % known'
set xlabel 'vertices'
set ylabel 'set change [s]'
set grid lc rgb '#dddddd' lt 1
set key outside right top Left reverse
set tics nomirror
set border 3
plot \
  'paper.csv' using ((strcol('way') eq 'paper' && strcol('method') eq 'fem' && strcol('part') eq 'update' && strcol('update') eq 'eqn9' && strcol('share') eq '0.1' ? column('vertices') : NaN)):(column('set_change_s')) with linespoints lc rgb '#0072b2' lw 2 pt 7 ps 0.8 dt 1 title 'fem, Eqn. 9', \
  'paper.csv' using ((strcol('way') eq 'paper' && strcol('method') eq 'fem' && strcol('part') eq 'update' && strcol('update') eq 'inverse' && strcol('share') eq '0.1' ? column('vertices') : NaN)):(column('set_change_s')) with linespoints lc rgb '#0072b2' lw 2 pt 7 ps 0.8 dt 2 title 'fem, without', \
  'paper.csv' using ((strcol('way') eq 'paper' && strcol('method') eq 'constant-bem' && strcol('part') eq 'update' && strcol('update') eq 'eqn9' && strcol('share') eq '0.1' ? column('vertices') : NaN)):(column('set_change_s')) with linespoints lc rgb '#d55e00' lw 2 pt 5 ps 0.8 dt 1 title 'constant-bem, Eqn. 9', \
  'paper.csv' using ((strcol('way') eq 'paper' && strcol('method') eq 'constant-bem' && strcol('part') eq 'update' && strcol('update') eq 'inverse' && strcol('share') eq '0.1' ? column('vertices') : NaN)):(column('set_change_s')) with linespoints lc rgb '#d55e00' lw 2 pt 5 ps 0.8 dt 2 title 'constant-bem, without', \
  'paper.csv' using ((strcol('way') eq 'paper' && strcol('method') eq 'linear-bem' && strcol('part') eq 'update' && strcol('update') eq 'eqn9' && strcol('share') eq '0.1' ? column('vertices') : NaN)):(column('set_change_s')) with linespoints lc rgb '#009e73' lw 2 pt 9 ps 0.8 dt 1 title 'linear-bem, Eqn. 9', \
  'paper.csv' using ((strcol('way') eq 'paper' && strcol('method') eq 'linear-bem' && strcol('part') eq 'update' && strcol('update') eq 'inverse' && strcol('share') eq '0.1' ? column('vertices') : NaN)):(column('set_change_s')) with linespoints lc rgb '#009e73' lw 2 pt 9 ps 0.8 dt 2 title 'linear-bem, without'
unset output
reset
}
