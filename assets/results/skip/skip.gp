# Draws skip.svg and skip.png: gnuplot skip.gp
set encoding utf8
do for [kind in 'svg png'] {
if (kind eq 'svg') {
set terminal svg size 900,520 font 'sans,14' background 'white'
} else {
set terminal pngcairo size 1350,780 font 'sans,18'
}
set output 'skip.'.kind
set datafile separator ','
set title 'What each skip saves'
set logscale x
set format x '%g'
set xlabel 'time without the skip / time with it'
unset key
set grid x lc rgb '#dddddd' lt 1
set border 3
set tics nomirror
set yrange [-0.7:*] reverse
set xrange [0.5:*]
set lmargin 42
plot 'skip.csv' using (column('without_s')/column('with_s')):0:(0.5):(column('without_s')/column('with_s')):($0-0.35):($0+0.35):ytic(strcol('skip').', '.strcol('method')) with boxxyerror fs solid 0.8 lc rgb '#0072b2'
unset output
reset
}
